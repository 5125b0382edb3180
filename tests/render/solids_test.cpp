// Bodies in space: what of them is seen, where, and how bright.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "encode/png.hpp"
#include "mesh/primitives.hpp"
#include "render/drawing.hpp"
#include "render/soft_shadow.hpp"
#include "render/solid_bounds.hpp"
#include "render/vector_shapes.hpp"
#include "support/picture_compare.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using Mesh = std::shared_ptr<const TriangleMesh>;

constexpr Color kRed = color_of(0xC02020), kGreen = color_of(0x20A020);
// Four by four samples a pixel on pages as low as these: a straight edge is off by an eighth of a pixel at
// most.
constexpr double kEdge = 0.125;

Mesh shared(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}
Mesh cube(double edge) {
  return shared(box_mesh({edge, edge, edge}));
}

// At (x, y, z) of the view, upright.
Solid at(const Mesh& mesh, double x, double y, double z, std::optional<Color> color = {}) {
  return {mesh, {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z}, color, {}};
}

// A metre is 64 px, and the view's origin the middle of the page.
Solids scene(std::vector<Solid> parts, double nearness = 0) {
  Solids solids;
  solids.parts = std::move(parts);
  solids.origin = {0.5, 0.5};
  solids.scale = 0.5;
  solids.nearing = {0, 0, nearness};
  return solids;
}

Solids silhouette(std::vector<Solid> parts, double nearness = 0) {
  Solids solids = scene(std::move(parts), nearness);
  solids.is_shadow = true;
  solids.outline = kBlack;
  return solids;
}

TEST(Solids, AreDarkerWhereTheySeeLessOfTheSky) {
  const Mesh mesh = cube(1);
  Solid part = at(mesh, 0, 0, 0);
  const auto middle = [&](std::optional<int> openness) {
    part.openness = openness ? std::make_shared<const std::vector<std::uint8_t>>(mesh->vertices.size(), std::uint8_t(*openness)) : nullptr;
    const Image image = draw_items({scene({part})});
    return int(image.at(image.width / 2, image.height / 2).g);
  };
  EXPECT_EQ(middle(255), middle(std::nullopt));
  EXPECT_LT(middle(128), middle(255) - 30);
  EXPECT_LT(middle(0), middle(128) - 30);
  // Numbers of another mesh are not believed.
  part.openness = std::make_shared<const std::vector<std::uint8_t>>(3, std::uint8_t(0));
  EXPECT_FALSE(is_drawable(scene({part})));
}

TEST(Solids, CoverTheAreaOfTheirOutline) {
  // 51.2 px a side; each of four edges is off by kEdge at most.
  EXPECT_NEAR(covered_area(draw_items({silhouette({at(cube(0.8), 0, 0, 0)})})), 51.2 * 51.2,
              4 * 51.2 * kEdge);
  const double radius = 0.7 * 64;
  // The sphere is a polyhedron inside the true one: short by 1 - cos(pi / 48) = 0.2 % of its radius at most.
  EXPECT_NEAR(covered_area(draw_items({silhouette({at(shared(sphere_mesh(0.7)), 0, 0, 0)})})),
              std::numbers::pi * radius * radius, 0.005 * std::numbers::pi * radius * radius);
  EXPECT_EQ(covered_area(draw_items({silhouette({})})), 0);
}

// As dark in sum as with hard edges, but spread: nothing changes farther away than the blur reaches, and between there are all
// levels. Twice as far along rows as across them.
TEST(Solids, ShadowsHaveSoftEdges) {
  const Image sharp = draw_items({silhouette({at(cube(0.5), 0, 0, 0)})});
  Solids blurred = silhouette({at(cube(0.5), 0, 0, 0)});
  constexpr double kBlur = 12;  // px
  blurred.outline_width = kBlur / kSide;
  const Image soft = draw_items({blurred});
  EXPECT_NEAR(covered_area(soft), covered_area(sharp), 0.01 * covered_area(sharp));  // levels are rounded
  std::set<int> across, along;
  for (int k = 0; k < kSide; ++k) {
    across.insert(int(std::lround(255 * darkness(soft, kSide / 2, k))));
    along.insert(int(std::lround(255 * darkness(soft, k, kSide / 2))));
    if (std::abs(k + 0.5 - kSide / 2.0) < 16 + kBlur + 1) continue;
    EXPECT_EQ(darkness(soft, k, kSide / 2), 0) << k;
    EXPECT_EQ(darkness(soft, kSide / 2, k), 0) << k;
  }
  EXPECT_GE(along.size(), 12u);
  EXPECT_GE(across.size(), 6u);
  EXPECT_GT(along.size(), across.size());
  EXPECT_NEAR(darkness(soft, kSide / 2, kSide / 2), 1, 0.01);
}

// On cells of one, two and four pixels: as dark in sum as with hard edges, half as dark at the edge, darker and darker to the
// middle, and nothing beyond what the blur says.
TEST(Solids, SoftShadowsLookTheSameOnCellsOfAnySize) {
  constexpr int kPage = 512;
  Canvas canvas(kPage, kPage, fonts());
  for (const auto& [blur, pixels] : {std::pair{12.0, 1}, {20.0, 2}, {32.0, 4}, {60.0, 4}}) {
    SCOPED_TRACE(blur);
    EXPECT_EQ(ShadowBlur(blur).pixels, pixels);
    for (const double moved : {0.0, 1.0, 2.5}) {  // px
      const double side = 200.3, metre = 0.5 * kPage;
      Solids shadow = silhouette({at(cube(side / metre), moved / metre, 0, 0)});
      shadow.outline_width = blur / kPage;
      Picture picture;
      picture.background = color_of(0xFFFFFF);
      picture.add(shadow);
      Image image;
      canvas.draw(picture, image);
      EXPECT_NEAR(covered_area(image), side * side, 0.02 * side * side);  // an edge is off by half a sample's distance at most
      const int middle = kPage / 2, rim = ShadowBlur(blur).rim();
      const double edge = middle + moved + side / 2;
      double before = 1;
      for (int x = middle; x < kPage; ++x) {
        const double dark = darkness(image, x, middle);
        EXPECT_LE(dark, before + 1e-9) << x;
        before = dark;
        if (x > edge + rim) EXPECT_EQ(dark, 0) << x;
      }
      // Half a sample's distance aside of a slope of one over a radius.
      const double slope = 1 / blur;
      EXPECT_NEAR(darkness(image, int(edge), middle), 0.5, slope * (pixels / 2.0 + 1)) << moved;
    }
  }
}

TEST(Solids, SoftShadowsFadeBeforeTheEdgesOfTheirScene) {
  Solids shadow = silhouette({at(cube(1.6), 0, 0, 0)});
  shadow.fade = {{0.2, 0.2, 0.8, 0.8}, 0.1, 0.1, 0.1, 0.1};
  const Image image = draw_items({shadow});
  const auto dark = [&](double x, double y) { return darkness(image, int(x * kSide), int((1 - y) * kSide)); };
  EXPECT_NEAR(dark(0.5, 0.5), 1, 0.01);
  EXPECT_NEAR(dark(0.25, 0.5), 0.5, 0.06);  // half of the stretch; a pixel is 0.08 of it
  EXPECT_NEAR(dark(0.5, 0.75), 0.5, 0.06);
  EXPECT_EQ(dark(0.15, 0.5), 0);
  EXPECT_EQ(dark(0.5, 0.1), 0);
}

TEST(Solids, StandWhereTheViewPutsThem) {
  // A quarter of a metre right and up: 16 px.
  const Image image = draw_items({silhouette({at(cube(0.25), 0.25, 0.25, 0)})});
  double x = 0, y = 0, sum = 0;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double dark = darkness(image, column, row);
      x += dark * (column + 0.5), y += dark * (row + 0.5), sum += dark;
    }
  EXPECT_NEAR(x / sum, 64 + 16, kEdge);
  EXPECT_NEAR(y / sum, 64 - 16, kEdge);
}

TEST(Solids, GrowTowardsTheEye) {
  // The front face of the cube, 0.2 m before the plane of scale 1, is seen from 2 m: 1 / (1 - 0.2 / 2) times
  // as large, and hides all that lies behind.
  const double side = 0.4 * 64 / (1 - 0.2 / 2);
  const Image image = draw_items({silhouette({at(cube(0.4), 0, 0, 0)}, 0.5)});
  EXPECT_NEAR(covered_area(image), side * side, 4 * side * kEdge);
  EXPECT_LT(covered_area(draw_items({silhouette({at(cube(0.4), 0, 0, 0)})})), 0.9 * side * side);
}

TEST(Solids, HaveCreasesWhereTheyBendByMoreThanThirtyDegrees) {
  EXPECT_EQ(MeshSurface(box_mesh({1, 2, 3})).creases.size(), 12u);
  EXPECT_EQ(MeshSurface(cylinder_mesh(0.3, 1)).creases.size(), 2 * 48u);  // its rims
  EXPECT_TRUE(MeshSurface(sphere_mesh(0.7)).creases.empty());
  // Two triangles that share an edge, each with its own normal.
  for (const double degrees : {-40.0, -20.0, 20.0, 29.0, 31.0, 90.0}) {
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    TriangleMesh mesh;
    const auto add = [&](double x, double y, double z, double nx, double nz) {
      mesh.vertices.push_back({{float(x), float(y), float(z)}, {float(nx), 0, float(nz)}});
    };
    add(0, 0, 0, 0, 1), add(0, 1, 0, 0, 1), add(-1, 0, 0, 0, 1);
    add(0, 0, 0, s, c), add(0, 1, 0, s, c), add(c, 0, -s, s, c);
    mesh.triangles = {0, 1, 2, 4, 3, 5};
    EXPECT_EQ(MeshSurface(mesh).creases.size(), std::abs(degrees) > 30 ? 1u : 0u) << degrees;
    // With one normal for both there is no line, however it is bent.
    for (std::size_t i = 3; i < 6; ++i) mesh.vertices[i].normal = {0, 0, 1};
    EXPECT_TRUE(MeshSurface(mesh).creases.empty()) << degrees;
  }
}

// The edge between two faces of a cube is darker than both; one that lies behind a face is not seen.
TEST(Solids, CreasesAreDarkLinesBeforeWhatTheyBound) {
  const double c = std::cos(0.6), s = std::sin(0.6);
  const auto turned = [&](double z, double edge, std::optional<Color> color) {
    return Solid{cube(edge), {c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, z}, color};
  };
  const Color grey = color_of(0xC0C0C0);
  const Image image = draw_items({scene({turned(0, 0.8, grey)})});
  const int edge = int(64 + 64 * 0.4 * (s - c));  // px: the vertical edge nearest to the viewer
  int darkest = 255;
  for (int x = edge - 2; x <= edge + 2; ++x) darkest = std::min(darkest, int(image.at(x, 64).g));
  EXPECT_LT(darkest, image.at(edge - 6, 64).g - 15);
  EXPECT_LT(darkest, image.at(edge + 6, 64).g - 15);
  // Negative control: what hides the cube hides its edges.
  const Image hidden = draw_items({scene({turned(0, 0.8, grey), at(cube(1.4), 0, 0, 2, grey)})});
  for (int x = edge - 6; x <= edge + 6; ++x) EXPECT_EQ(hidden.at(x, 64).g, hidden.at(64, 64).g);
}

TEST(Solids, HideWhatLiesBehindThemInAnyOrder) {
  const Solid before = at(cube(0.4), 0, 0, 0.5, kRed), behind = at(cube(0.8), 0, 0, -0.5, kGreen);
  const Image one = draw_items({scene({before, behind})}), other = draw_items({scene({behind, before})});
  EXPECT_EQ(largest_difference(one, other), 0);
  const auto is_red = [](const Pixel& p) { return p.r > 2 * p.g; };
  EXPECT_TRUE(is_red(one.at(64, 64)));
  EXPECT_FALSE(is_red(one.at(64 + 20, 64)));
  // The other way round the small one is inside of nothing, but behind.
  const Image swapped =
      draw_items({scene({at(cube(0.4), 0, 0, -0.5, kRed), at(cube(0.8), 0, 0, 0.5, kGreen)})});
  EXPECT_FALSE(is_red(swapped.at(64, 64)));
}

TEST(Solids, AreBrightestTowardsTheLight) {
  const Image image = draw_items({scene({at(shared(sphere_mesh(0.8)), 0, 0, 0, color_of(0xFFFFFF))})});
  const auto level = [&](double x, double y) { return int(image.at(int(64 + 51 * x), int(64 - 51 * y)).g); };
  EXPECT_GT(level(-0.4, 0.5), level(0.5, -0.5) + 60);  // upper left in front
  EXPECT_GT(level(0, 0), level(0, -0.9) + 40);
  EXPECT_LT(level(0, 0), 252);       // a white body stands out from a white page
  EXPECT_GT(level(0.85, -0.3), 60);  // and no side is black
}

TEST(Solids, ShineThroughAsOne) {
  Solids half = scene({at(cube(0.4), 0, 0, 0.5, kRed), at(cube(0.8), 0, 0, -0.5, kGreen)});
  const Image whole = draw_items({half});
  half.opacity = 0.5;
  const Image faded = draw_items({half});
  for (const int x : {64, 64 + 20}) {
    // Halfway to the white page: what is hidden stays hidden.
    EXPECT_NEAR(faded.at(x, 64).r, (255 + whole.at(x, 64).r) / 2.0, 1.5);
    EXPECT_NEAR(faded.at(x, 64).g, (255 + whole.at(x, 64).g) / 2.0, 1.5);
  }
}

TEST(Solids, TranslucentPartsShowWhatLiesBehind) {
  Color glass = kRed;
  glass.a = 0.5;
  const Solid pane = at(cube(0.4), 0, 0, 0.5, glass), wall = at(cube(0.8), 0, 0, -0.5, kGreen);
  const Image both = draw_items({scene({pane, wall})}), alone = draw_items({scene({wall})});
  EXPECT_GT(both.at(64, 64).r, alone.at(64, 64).r + 30);
  EXPECT_GT(both.at(64, 64).g, 20);
  EXPECT_EQ(largest_difference(both, draw_items({scene({wall, pane})})), 0);
}

// One mesh with an opaque part before another and a pane: the pane costs the others neither order nor depth.
TEST(Solids, OpaqueTrianglesOfAMeshHideOthersAlsoBesideTranslucentOnes) {
  TriangleMesh mesh;
  const auto add = [&](const TriangleMesh& part, double x, double z, std::array<std::uint8_t, 4> color) {
    const auto shift = std::uint32_t(mesh.vertices.size());
    for (TriangleMesh::Vertex vertex : part.vertices) {
      vertex.position[0] += float(x);
      vertex.position[2] += float(z);
      vertex.color = color;
      mesh.vertices.push_back(vertex);
    }
    for (const std::uint32_t index : part.triangles) mesh.triangles.push_back(index + shift);
  };
  add(box_mesh({0.4, 0.4, 0.1}), 0, 0.5, {200, 0, 0, 255});
  add(box_mesh({0.4, 0.4, 0.1}), 0, -0.5, {0, 0, 200, 255});
  add(box_mesh({0.1, 0.1, 0.1}), 0.7, 0, {0, 200, 0, 128});
  const SortedTriangles sorted = MeshSurface(mesh).triangles;
  EXPECT_EQ(sorted.closed, 24u);
  EXPECT_EQ(sorted.opaque, 24u);
  const Pixel middle = draw_items({scene({at(shared(mesh), 0, 0, 0)})}).at(64, 64);
  EXPECT_GT(middle.r, 100);
  EXPECT_LT(middle.b, 60);
}

// A wire thinner than its outline: the line has no holes.
TEST(Solids, OutlinesOfThinBodiesAreWhole) {
  Solids wire = scene({at(shared(cylinder_mesh(0.002, 1.2)), 0, 0, 0, color_of(0xFFFFFF))});
  wire.parts[0].to_view = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0};  // upright on the page
  wire.outline = kBlack;
  wire.outline_width = 6 * kPx;
  const Image image = draw_items({wire});
  for (const int x : {60, 61, 62, 65, 66, 67}) EXPECT_GT(darkness(image, x, 64), 0.9) << x;
}

TEST(Solids, HaveAnOutlineOfTheirWidth) {
  Solids lined = scene({at(cube(0.8), 0, 0, 0, color_of(0xFFFFFF))});
  const double bare = covered_area(draw_items({lined}));
  lined.outline = kBlack;
  lined.outline_width = 3 * kPx;
  const double line = covered_area(draw_items({lined})) - bare;
  // Four sides and four rounded corners of 3 px; twelve directions make the ring up to a tenth too thin.
  const double ring = 4 * 51.2 * 3 + std::numbers::pi * 9;
  EXPECT_NEAR(line, ring, 0.12 * ring);
}

// A gap between two bodies, one of them just beyond the page: at all four sides the line is that of the other alone.
TEST(Solids, BeyondThePageHaveNoLineOnIt) {
  for (const auto& [x, y] : {std::pair(1.0, 0.0), std::pair(-1.0, 0.0), std::pair(0.0, 1.0), std::pair(0.0, -1.0)}) {
    // A page is 2 m wide; the second body begins 1 px beyond its side, a line's reach is 6 px.
    Solids alone = scene({at(cube(0.5), 0, 0, 0, kRed)});
    alone.outline = kBlack;
    alone.outline_width = 6 * kPx;
    Solids both = alone;
    both.parts.push_back(at(cube(0.5), (1.25 + 1.0 / 64) * x, (1.25 + 1.0 / 64) * y, 0, kRed));
    EXPECT_EQ(largest_difference(draw_items({both}), draw_items({alone})), 0) << x << " " << y;
  }
}

TEST(Solids, StayInsideOfTheirClip) {
  Canvas canvas(kSide, kSide, fonts());
  Picture picture;
  picture.clips = {{0.25, 0.25, 0.5, 0.75}};
  picture.add(silhouette({at(cube(1.8), 0, 0, 0)}), 0);
  Image image;
  canvas.draw(picture, image);
  EXPECT_NEAR(covered_area(image), 32 * 64, 1e-9);
}

// A second body elsewhere, then the first again: nothing of an earlier frame is left.
TEST(Solids, LeaveNothingBehindForTheNextFrame) {
  Solids lined = scene({at(cube(0.5), -0.3, 0, 0, kRed)});
  lined.outline = kBlack;
  lined.outline_width = 4 * kPx;
  const Image first = draw_items({lined});
  draw_items({silhouette({at(cube(1.6), 0.1, 0.1, 0)})});
  EXPECT_EQ(largest_difference(first, draw_items({lined})), 0);
}

// Culling leaves out what is never seen, and nothing else.
TEST(Solids, ClosedPartsLookAsTheyWouldWithAllTriangles) {
  TriangleMesh torn = sphere_mesh(0.7);
  ASSERT_EQ(MeshSurface(torn).triangles.closed, torn.triangles.size() / 3);
  const Image closed = draw_items({scene({at(shared(torn), 0.1, 0, 0, kRed)})});
  // The first triangle twice: no edge of it joins just two, so the part counts as open and all is drawn.
  for (int k = 0; k < 3; ++k) torn.triangles.push_back(torn.triangles[std::size_t(k)]);
  ASSERT_EQ(MeshSurface(torn).triangles.closed, 0u);
  EXPECT_EQ(largest_difference(closed, draw_items({scene({at(shared(torn), 0.1, 0, 0, kRed)})})), 0);
}

TEST(Solids, OpenPartsAreSeenFromBehind) {
  TriangleMesh lid = box_mesh({0.8, 0.8, 0.8});
  lid.triangles.resize(lid.triangles.size() - 3);
  EXPECT_EQ(MeshSurface(lid).triangles.closed, 0u);
  TriangleMesh inside_out = box_mesh({0.8, 0.8, 0.8});
  for (std::size_t t = 0; t < inside_out.triangles.size(); t += 3)
    std::swap(inside_out.triangles[t], inside_out.triangles[t + 1]);
  EXPECT_EQ(MeshSurface(inside_out).triangles.closed, 0u);
  EXPECT_GT(covered_area(draw_items({silhouette({at(shared(inside_out), 0, 0, 0)})})), 51 * 51);
}

TEST(Solids, ClosedPartsComeFirstWhereAMeshHasBoth) {
  TriangleMesh two = box_mesh({1, 1, 1});
  const TriangleMesh other = box_mesh({0.5, 0.5, 0.5});
  const auto shift = std::uint32_t(two.vertices.size());
  two.triangles.resize(two.triangles.size() - 3);  // the first box is open
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const std::uint32_t index : other.triangles) two.triangles.push_back(index + shift);
  const SortedTriangles sorted = MeshSurface(two).triangles;
  EXPECT_EQ(sorted.closed, 12u);
  EXPECT_EQ(sorted.indices.size(), two.triangles.size());
  EXPECT_GE(sorted.indices.front(), shift);
}

TEST(Solids, ThatAreNoNumbersAreLeftOut) {
  Solid broken = at(cube(0.8), 0, 0, 0, kRed);
  broken.to_view[3] = NAN;
  EXPECT_EQ(covered_area(draw_items({scene({broken})})), 0);
  EXPECT_EQ(covered_area(draw_items({scene({Solid{nullptr, broken.to_view, {}}})})), 0);
  Solids behind_the_eye = scene({at(cube(0.2), 0, 0, 5)}, 0.5);
  EXPECT_NO_THROW(draw_items({behind_the_eye}));
}

TEST(Solids, WithTrianglesBetweenMissingVerticesAreAnError) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  mesh.triangles.back() = 1000;
  EXPECT_THROW(draw_items({scene({at(shared(mesh), 0, 0, 0)})}), Error);
}

// Its nearest triangles reach behind the eye, its farthest nearly to the horizon, which is at the middle of the page.
TEST(Solids, ThatReachBehindTheEyeAreCutThere) {
  const Mesh ground = shared(box_mesh({400, 0.01, 400}));
  const Image page = draw_items({silhouette({at(ground, 0, -0.5, 0)}, 0.5)});
  EXPECT_NEAR(covered_area(page), 0.5 * page.width * page.height, 0.01 * page.width * page.height);
}

TEST(Solids, OnlyWhereABodyHasMovedThePageIsDrawnAgain) {
  Solids before = scene({at(cube(0.4), -0.6, 0.6, 0, kRed), at(cube(0.4), 0.5, -0.5, 0, kGreen)});
  before.outline = kBlack;
  before.outline_width = 2 * kPx;
  Solids now = before;
  now.parts[1] = at(now.parts[1].mesh, 0.55, -0.5, 0.1, kGreen);
  Picture empty, first, second;
  empty.aspect = first.aspect = second.aspect = 1;
  first.add(before);
  second.add(now);
  constexpr int kSide = 256;
  const auto canvas = [&] {
    auto made = std::make_unique<Canvas>(kSide, kSide, fonts());
    made->set_static_layer(empty);
    return made;
  };
  const auto drawn = canvas(), fresh = canvas();
  drawn->draw(first);
  const CanvasFrame& frame = drawn->draw(second);
  EXPECT_EQ(frame.image.bgra, fresh->draw(second).image.bgra);
  for (const PixelBox& box : frame.changed) EXPECT_TRUE(box.x >= kSide / 2 && box.y >= kSide / 2) << box.x << " " << box.y;
}

class SolidsAsVectors : public ::testing::Test {
 protected:
  SolidsAsVectors() {
    picture.aspect = 16.0 / 9;
    Solids solids =
        scene({at(shared(sphere_mesh(0.5)), 0.5, 0, 0, kRed), at(cube(0.5), 1, 0.2, 0.3, kGreen)});
    solids.outline = kBlack;
    solids.outline_width = 0.004;
    picture.add(Capsule{{0.1, 0.1}, {1.6, 0.9}, 0.01, {kBlack, {}, 0}});
    picture.add(std::move(solids));
    Canvas canvas(960, 540, fonts());
    canvas.draw(picture, by_canvas);
  }
  Picture picture;
  Image by_canvas;
};

// The picture inside of the page has four times the pixels of this canvas a side and is drawn smaller: only
// edges differ.
constexpr double kMeanOfEdges = 0.6;

TEST_F(SolidsAsVectors, LookTheSameInSvg) {
  const TemporaryFolder folder;
  const std::string text = svg_text(picture, fonts(), {540, "", "", ""});
  EXPECT_THAT(text, testing::HasSubstr("<image "));
  const std::string png = folder.file("page.png");
  const ProgramResult result = run_command({"rsvg-convert", folder.write("page.svg", text), "-o", png});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_LT(compare_pictures(by_canvas, read_png(png)).mean, kMeanOfEdges);
}

TEST_F(SolidsAsVectors, LookTheSameInPdf) {
  const TemporaryFolder folder;
  const std::string pdf = folder.write("page.pdf", pdf_text(picture, fonts(), {540, "", "", ""}));
  const ProgramResult result =
      run_command({"pdftocairo", "-png", "-singlefile", "-r", "72", pdf, folder.file("page")});
  ASSERT_EQ(result.status, 0) << result.err;
  const Image page = read_png(folder.file("page.png"));
  EXPECT_LT(compare_pictures(by_canvas, page).mean, kMeanOfEdges);
  // Without the bodies the pictures differ by far more.
  Picture bare = picture;
  bare.items.pop_back();
  Canvas canvas(960, 540, fonts());
  Image without;
  canvas.draw(bare, without);
  EXPECT_GT(compare_pictures(without, page).mean, 5 * kMeanOfEdges);
}

}  // namespace
}  // namespace chainreel
