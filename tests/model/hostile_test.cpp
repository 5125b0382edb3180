// Files made to exhaust a reader. Each is read in a child that has 200 MB and two seconds of processor time
// (the worst of them took 0.7 s when this was written), so that taking more is seen as its end and not as a
// slow test.
#include <gmock/gmock.h>

#include <clocale>
#include <locale>

#include "mesh/limited_child.hpp"
#include "model/doctor.hpp"
#include "model/xml_text.hpp"
#include "model_file.hpp"

namespace chainreel {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

#ifdef __SANITIZE_ADDRESS__
constexpr int kSeconds = 20;  // sanitizers slow everything down
#else
constexpr int kSeconds = 2;
#endif

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// "3: message" or "7: message"; "read" where there is no error; how the child died, where it did.
std::string outcome(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.write("hostile.urdf", text);
  ChildLimits limits;
  limits.memory = std::size_t(200) << 20;
  limits.cpu_seconds = kSeconds;
  const ChildResult result = run_in_limited_child(
      [&]() -> std::string {
        try {
          read_chain(path);
          return "read";
        } catch (const Error& error) {
          return std::to_string(int(error.code())) + ": " + error.what();
        }
      },
      limits);
  return result.finished ? result.reply : "died: " + result.trouble;
}

// `n` links in a row, each as small as it can be.
std::string row(int n, const std::string& inside) {
  std::string text = link_text("l0");
  for (int i = 1; i <= n; ++i) {
    const std::string name = "l" + std::to_string(i);
    text += "<link name='" + name + "'>" + inside + "</link><joint name='j" + std::to_string(i) +
            "' type='continuous'><parent link='l" + std::to_string(i - 1) + "'/><child link='" + name +
            "'/></joint>\n";
  }
  return robot_text(text);
}

TEST(HostileXml, DeepNestingIsRefusedBeforeAnyParserRecurses) {
  const std::string open = repeated("<a>", 200'000), close = repeated("</a>", 200'000);
  EXPECT_THAT(outcome("<robot name='r'>" + open + close + "</robot>"), HasSubstr("7: "));
  EXPECT_THAT(outcome("<robot name='r'>" + open), HasSubstr("nested deeper than 64"));
  // As deep as allowed is fine, and what looks like tags inside comments, CDATA and attributes is none.
  const int depth = kDeepestXml - 2;
  EXPECT_THAT(outcome(robot_text(repeated("<a>", depth) + repeated("</a>", depth))), HasSubstr("3: "));
  const std::string hidden =
      "<!--" + open + "--><x y='" + repeated("&lt;a>", 1000) + "'/><![CDATA[" + open + "]]>";
  EXPECT_THAT(outcome(robot_text(hidden)), HasSubstr("the model has no link"));
}

TEST(HostileXml, AHundredThousandLinksAreALimit) {
  EXPECT_THAT(outcome(row(100'000, inertial_text())), HasSubstr("7: "));
  EXPECT_THAT(outcome(row(100'000, "")), HasSubstr("has more than 150000 elements"));
  // The largest rows below the limit end as well; they are legal but for their masses.
  EXPECT_THAT(outcome(row(37'000, "")), HasSubstr("moves (joint 'j1') but has no <inertial>"));
}

TEST(HostileXml, CyclicParentsAreAnError) {
  std::string ring = link_text("root");
  const int n = 30'000;
  for (int i = 0; i < n; ++i) {
    ring += "<link name='l" + std::to_string(i) + "'/><joint name='j" + std::to_string(i) +
            "' type='continuous'><parent link='l" + std::to_string(i) + "'/><child link='l" +
            std::to_string((i + 1) % n) + "'/></joint>\n";
  }
  EXPECT_THAT(outcome(robot_text(ring)), HasSubstr("form a loop that hangs on nothing"));
}

TEST(HostileXml, ManyProblemsDoNotTakeLong) {
  EXPECT_THAT(outcome(robot_text(repeated("<link name='a'/>", 100'000))), HasSubstr("more problems"));
  std::string lost = link_text("base");
  for (int i = 0; i < 20'000; ++i) {
    const std::string n = std::to_string(i);
    lost += "<link name='link" + n + "'/><joint name='j" + n + "' type='fixed'><parent link='lnk" + n +
            "x'/><child link='link" + n + "'/></joint>\n";
  }
  EXPECT_THAT(outcome(robot_text(lost)), HasSubstr("and 19970 more problems"));
  // Long names that are nearly each other, among which a misspelt one would be looked for.
  std::string near = link_text("base");
  for (int i = 0; i < 900; ++i) {
    const std::string name = std::string(4000, 'x') + std::to_string(i);
    near += "<link name='" + name + "'/><joint name='j" + std::to_string(i) +
            "' type='fixed'><parent link='y" + name + "'/><child link='" + name + "'/></joint>\n";
  }
  EXPECT_THAT(outcome(robot_text(near)), HasSubstr("and 870 more problems"));
}

TEST(HostileXml, LongNamesAttributesAndTextsAreHeldToTheLimits) {
  const std::string megabytes(15'000'000, '1');
  const std::string too_long = "a tag is longer than 8192 characters";
  EXPECT_THAT(outcome(robot_text("<link name='" + megabytes + "'/>")), HasSubstr(too_long));
  EXPECT_THAT(outcome(robot_text(link_text("a", "<inertial><mass value='" + megabytes + "'/></inertial>"))),
              HasSubstr(too_long));
  EXPECT_THAT(outcome(robot_text(megabytes + "<link name='a'/>")), HasSubstr("nothing moves"));
  EXPECT_THAT(outcome(robot_text("<link " + repeated("a='1' ", 1'000'000) + "/>")),
              HasSubstr("a tag has more than 64 attributes"));
  EXPECT_THAT(outcome(robot_text(megabytes + megabytes)), HasSubstr("is larger than 16 MiB"));
  // Entities that would multiply are not expanded.
  EXPECT_THAT(outcome("<!DOCTYPE r [<!ENTITY a '" + repeated("x", 1000) +
                      "'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>]>" + robot_text("<link name='&b;'/>")),
              HasSubstr("3: "));
}

TEST(HostileXml, NumbersThatAreNoneAreErrors) {
  for (const char* number :
       {"nan", "inf", "-inf", "NaN", "1e999", "-1e999", "0x1p3", "1,5", "", " ", "1 2", "--1", "1e"}) {
    const std::string inertial = std::string("<inertial><mass value='") + number +
                                 "'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
    EXPECT_THAT(outcome(row(1, inertial)), HasSubstr("is not a number")) << number;
  }
  EXPECT_EQ(outcome(row(1, inertial_text())), "read");
}

TEST(HostileXml, RandomCutsAndChangesEndInAnErrorOrAModel) {
  std::ifstream stream(CHAINREEL_SOURCE "/tests/model/good/every_joint_kind.urdf");
  const std::string good((std::istreambuf_iterator<char>(stream)), {});
  const TemporaryFolder folder;
  unsigned state = 1;  // a small generator of our own: the same changes everywhere
  const auto below = [&](std::size_t n) {
    state = state * 1664525u + 1013904223u;
    return std::size_t(state >> 8) % n;
  };
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    std::string text = good;
    for (std::size_t k = 0, changes = 1 + below(4); k < changes; ++k) {
      const std::size_t at = below(text.size());
      switch (below(3)) {
        case 0:
          text[at] = "<>/\"'=&! 0-e.\xff"[below(14)];
          break;
        case 1:
          text.erase(at, 1 + below(30));
          break;
        default:
          text.insert(at, text.substr(below(text.size()), 1 + below(60)));
          break;
      }
    }
    const std::string path = folder.write("changed.urdf", text);
    if (!refusal_of(path).empty()) ++refused;
    for (const Finding& finding : examine_model(path)) EXPECT_FALSE(finding.message.empty());
  }
  EXPECT_GT(refused, 100);
  EXPECT_LT(refused, 500);
}

// Decimal commas, as a German locale has them.
class DecimalComma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(HostileXml, ALocaleWithDecimalCommasChangesNoNumber) {
  const std::string good =
      robot_text(link_text("base") + link_text("arm", inertial_text(1234.5, "0.25 0 0")) +
                 joint_text("swing", "continuous", "base", "arm", "0 0 1"));
  const std::string comma = inertial_text(1, "0,25 0 0");
  const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  const Chain chain = chain_from(good);
  const std::string refusal = outcome(row(1, comma));
  std::setlocale(LC_ALL, c_before.c_str());
  std::locale::global(before);
  EXPECT_EQ(chain.bodies[1].inertia.mass, 1234.5);
  EXPECT_EQ(chain.bodies[1].inertia.com[0], 0.25);
  EXPECT_THAT(refusal, HasSubstr("'0,25' is not a number: write it with a decimal point"));
}

TEST(HostileXml, ChainsOfTenThousandLinksAreRead) {
  // Neither reading nor throwing the model away may recurse by depth.
  EXPECT_EQ(outcome(row(10'000, inertial_text())), "read");
}

TEST(HostileXml, TheLimitsOfTheChildAreFelt) {
  // What the tests above rely on: a file that needs more than it has does not end in an error.
  ChildLimits limits;
  limits.memory = std::size_t(1) << 20;
  limits.cpu_seconds = kSeconds;
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes all address space, so the limit is not set";
#endif
  const TemporaryFolder folder;
  const std::string path = folder.write("row.urdf", row(10'000, inertial_text()));
  const ChildResult result = run_in_limited_child(
      [&] {
        read_chain(path);
        return std::string("read");
      },
      limits);
  EXPECT_FALSE(result.finished);
  EXPECT_THAT(result.trouble, HasSubstr("ran out of memory"));
}

}  // namespace
}  // namespace chainreel
