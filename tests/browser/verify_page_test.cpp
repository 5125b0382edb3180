// The report of `verify` as a browser shows it: keys, slider, blinking, filters; it asks for nothing and is
// silent.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "app/verify/html_report.hpp"
#include "browser/page_check.hpp"
#include "compare/compare_images.hpp"
#include "core/error.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const char* const kHostileName = "a < b & \"c\" 'd' <script>document.title = 'gone'</script>";

// A bar of two links at (x, y) on light paper.
Image bar_at(int x, int y, Pixel color = {0x56, 0xB4, 0xE9, 255}, int width = 320) {
  Image image(width, 180);
  for (int row = 0; row < 180; ++row)
    for (int column = 0; column < width; ++column) {
      const bool inside = column >= x && column < x + 140 && row >= y && row < y + 16;
      const Pixel p = inside ? color : Pixel{250, 250, 250, 255};
      std::uint8_t* target = &image.bgra[std::size_t(4 * (row * width + column))];
      target[0] = p.b;
      target[1] = p.g;
      target[2] = p.r;
      target[3] = 255;
    }
  return image;
}

ReportPicture report_picture(const std::string& name, const std::string& state, const Image& before,
                             const Image& after, std::vector<std::string> words, bool passes = false) {
  const ImageDifference difference = compare_images(before, after, {});
  const Image shown = difference_picture(before, after, {});
  return {.name = name,
          .state = state,
          .source = "arm.urdf",
          .words = std::move(words),
          .expected_png = png_bytes(before),
          .actual_png = png_bytes(after),
          .difference_png = shown.bgra.empty() || difference.is_equal() ? "" : png_bytes(shown),
          .worst = difference.worst,
          .beyond = difference.beyond,
          .tolerance = "error 0.1, 0 pixels (default)",
          .passes = passes};
}

VerifyReport small_report() {
  VerifyReport report{.suite = "arm <suite>.yaml",
                      .accept_command = "chainreel verify 'arm <suite>.yaml' --accept reach",
                      .program = "chainreel 1.2.3",
                      .pictures = {}};
  const Image home = bar_at(60, 60);
  report.pictures = {
      report_picture("home", "same", home, home, {}, true),
      report_picture(
          "reach", "changed", home, bar_at(75, 64),
          {"joint elbow: origin moved by 4 mm", "link forearm: mass 1.2 -> 1.25 kg, URDF line 31"}),
      report_picture("folded", "same", bar_at(20, 100), bar_at(20, 100), {}, true),
      report_picture(kHostileName, "pixels", home, bar_at(60, 60, {0xE6, 0x9F, 0x00, 255}),
                     {"theme: light -> dark"}),
      report_picture("wide", "size", home, bar_at(60, 60, {0x56, 0xB4, 0xE9, 255}, 400), {"another size"}),
      {.name = "lost",
       .state = "failed",
       .source = "gone.urdf",
       .words = {"gone.urdf: there is no such file"}}};
  report.pictures[5].tolerance = "error 0.1, 0 pixels (default)";
  return report;
}

class VerifyPage : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    try {
      folder_ = std::make_unique<TemporaryFolder>();
      write_html_report(page(), small_report(), false);
      browser_ = std::make_unique<Browser>();
    } catch (const std::exception& error) {
      trouble_ = error.what();
    }
  }
  static void TearDownTestSuite() {
    browser_.reset();
    folder_.reset();
  }
  void SetUp() override {
    ASSERT_EQ(trouble_, "");
    browser_->resize(1280, 900);
    open();
  }
  static void open() {
    browser_->open("about:blank");  // so that nothing of the last test is left, not even the hash
    browser_->open("file://" + page());
  }

  static std::string page() { return folder_->file("report.html"); }
  static Json run(const std::string& body) { return browser_->run(body); }
  static void press(const std::string& keys) {
    for (const char key : keys)
      run("document.body.dispatchEvent(new KeyboardEvent('keydown', {key: '" + std::string(1, key) +
          "', bubbles: true, cancelable: true}))");
  }
  static Json shown_name() { return run("return $('main article:not([hidden]) h2')?.textContent ?? null"); }
  static Json listed_names() {
    return run("return all('#list li').filter((r) => !r.hidden).map((r) => $('.name', r).textContent)");
  }
  // What the images of the view are once they are decoded.
  static Json shown_images() {
    return browser_->run_async(R"js(
      const images = all('main article:not([hidden]) .view img');
      await Promise.all(images.map((i) => i.decode()));
      return images.map((i) => `${i.alt} ${i.naturalWidth}`);
    )js");
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static std::unique_ptr<Browser> browser_;
  static std::string trouble_;
};
std::unique_ptr<TemporaryFolder> VerifyPage::folder_;
std::unique_ptr<Browser> VerifyPage::browser_;
std::string VerifyPage::trouble_;

TEST_F(VerifyPage, IsSilentAndAsksForNothing) {
  for (const char* keys : {"", "sjlbdzz", "jjj", "a"}) press(keys);
  EXPECT_THAT(problems_of_page(*browser_, page(), {}), IsEmpty());
}

TEST_F(VerifyPage, ListsWhatFailedFirst) {
  EXPECT_EQ(listed_names(), (Json{"reach", kHostileName, "wide", "lost", "home", "folded"}));
  EXPECT_EQ(shown_name(), "reach");
  EXPECT_EQ(run("return $('#summary').textContent"), "4 of 6 pictures failed");
  EXPECT_EQ(run("return all('.chip').map((c) => c.textContent)"),
            (Json{"all 6", "changed 1", "pixels 1", "size 1", "failed 1", "same 2"}));
}

TEST_F(VerifyPage, ShowsTextsAsTheyWereWritten) {
  EXPECT_EQ(run("return document.title"), "4 of 6 pictures failed: arm <suite>.yaml");
  EXPECT_EQ(run("return $('h1').textContent"), "arm <suite>.yaml");
  EXPECT_EQ(run("return all('main article:not([hidden]) li').map((l) => l.textContent)"),
            (Json{"joint elbow: origin moved by 4 mm", "link forearm: mass 1.2 -> 1.25 kg, URDF line 31"}));
  press("j");
  EXPECT_EQ(shown_name(), kHostileName);
  EXPECT_EQ(run("return all('main script').filter((s) => s.type !== 'text/plain').length"), 0);
  EXPECT_EQ(run("return document.getElementById('accept-2').textContent"),
            "chainreel verify 'arm <suite>.yaml' --accept 'a < b & \"c\" '\\''d'\\'' "
            "<script>document.title = '\\''gone'\\''</script>'");
}

TEST_F(VerifyPage, GoesThroughThePicturesByKeys) {
  press("jj");
  EXPECT_EQ(shown_name(), "wide");
  EXPECT_EQ(run("return location.hash"), "#picture-3");
  press("k");
  EXPECT_EQ(shown_name(), kHostileName);
  press("kkk");
  EXPECT_EQ(shown_name(), "reach") << "the first one stays";
  press("jjjjjjjjj");
  EXPECT_EQ(shown_name(), "folded") << "so does the last";
  run("document.body.dispatchEvent(new KeyboardEvent('keydown', {key: 'k', ctrlKey: true, bubbles: true}))");
  EXPECT_EQ(shown_name(), "folded") << "keys of the browser are not ours";
}

TEST_F(VerifyPage, DecodesWhatIsLookedAtAlone) {
  EXPECT_EQ(run("return all('main img').length"), 3);
  EXPECT_EQ(shown_images(), (Json{"expected 320", "actual 320", "difference 320"}));
  press("j");
  EXPECT_EQ(run("return all('main img').length"), 3) << "those of the picture before are gone";
  press("jj");
  EXPECT_EQ(shown_name(), "lost");
  EXPECT_EQ(run("return all('main img, main .modes').length"), 0);
  press("j");
  EXPECT_EQ(shown_images(), (Json{"expected 320", "actual 320"})) << "the same bytes, that stand there once";
  EXPECT_EQ(run("return document.getElementById('actual-5').textContent"), "");
}

TEST_F(VerifyPage, SlidesBetweenBoth) {
  press("l");
  EXPECT_EQ(shown_images(), (Json{"expected 320", "actual 320"}));
  const std::string cut =
      "return $('.pile img + img').style.clipPath.match(/ ([0-9.]+)px\\)/)[1] / "
      "$('.pile').getBoundingClientRect().width";
  browser_->run_async("for (let i = 0; i < 3; ++i) await new Promise(requestAnimationFrame)");
  EXPECT_NEAR(run(cut).get<double>(), 0.5, 1e-3);
  run("const r = $('input[type=range]'); r.value = 20; r.dispatchEvent(new Event('input'))");
  EXPECT_NEAR(run(cut).get<double>(), 0.2, 1e-3);
  // Dragged over the pictures themselves.
  run("const p = $('.pile'), b = p.getBoundingClientRect(); p.setPointerCapture = () => {};"
      "p.dispatchEvent(new PointerEvent('pointerdown', {clientX: b.left + 0.75 * b.width, clientY: b.top + "
      "5}))");
  EXPECT_NEAR(run(cut).get<double>(), 0.75, 1e-3);
  EXPECT_EQ(run("return $('input[type=range]').value"), "75");
}

TEST_F(VerifyPage, BlinksUntilAnotherViewIsAskedFor) {
  press("b");
  const Json seen = browser_->run_async(R"js(
    const seen = new Set();
    for (let i = 0; i < 40 && seen.size < 2; ++i) {
      seen.add($('figcaption').textContent);
      await new Promise((go) => setTimeout(go, 50));
    }
    return [...seen].sort();
  )js");
  EXPECT_EQ(seen, (Json{"actual", "expected"}));
  press("d");
  EXPECT_EQ(shown_images(), Json::array({"difference 320"}));
  EXPECT_EQ(run("return $('[data-mode=difference]').ariaPressed"), "true");
  press("jj");
  EXPECT_EQ(run("return $('article:not([hidden]) [aria-pressed=true]').dataset.mode"), "side")
      << "sizes that differ have no difference to show";
}

TEST_F(VerifyPage, ShowsPixelsAtRealSize) {
  browser_->resize(700, 900);
  press("dz");
  shown_images();
  EXPECT_EQ(run("return $('article:not([hidden]) img').getBoundingClientRect().width"), 320);
  press("z");
  shown_images();
  EXPECT_LE(run("return $('article:not([hidden]) img').getBoundingClientRect().right").get<double>(), 700);
}

TEST_F(VerifyPage, FiltersByStateAndWords) {
  run("$('.chip[data-filter=same]').click()");
  EXPECT_EQ(listed_names(), (Json{"home", "folded"}));
  EXPECT_EQ(shown_name(), "home");
  press("jjj");
  EXPECT_EQ(shown_name(), "folded") << "keys stay among what is listed";
  run("$('.chip[data-filter=\"\"]').click()");
  EXPECT_EQ(listed_names().size(), 6u);
  press("/");
  EXPECT_EQ(run("return document.activeElement.id"), "search");
  run("$('#search').dispatchEvent(new KeyboardEvent('keydown', {key: 'j', bubbles: true}))");
  EXPECT_EQ(shown_name(), "folded") << "letters typed there are no keys";
  run("const s = $('#search'); s.value = 'ELBOW'; s.dispatchEvent(new Event('input'))");
  EXPECT_EQ(listed_names(), (Json{"reach"}));
  EXPECT_EQ(shown_name(), "reach");
  run("const s = $('#search'); s.value = 'nothing like that'; s.dispatchEvent(new Event('input'))");
  EXPECT_EQ(shown_name(), nullptr);
  EXPECT_EQ(run("return $('#none').hidden"), false);
  press("jka");
  EXPECT_THAT(browser_->complaints(), IsEmpty());
}

TEST_F(VerifyPage, CopiesTheCommandThatAccepts) {
  run("window.copied = []; navigator.clipboard.writeText = async (text) => { copied.push(text); }");
  press("a");
  run("$('[data-text=accept-all]').click()");
  EXPECT_EQ(run("return copied"), (Json{"chainreel verify 'arm <suite>.yaml' --accept reach",
                                        "chainreel verify 'arm <suite>.yaml' --accept reach"}));
  run("$('.chip[data-filter=same]').click()");
  press("a");
  EXPECT_EQ(run("return copied.length"), 2);
  EXPECT_EQ(run("return $('#said').textContent"), "There is nothing to accept here.");
}

TEST_F(VerifyPage, SelectsTheCommandWhereTheClipboardIsClosed) {
  run("navigator.clipboard.writeText = async () => { throw new Error('closed'); }");
  press("a");
  browser_->run_async("await new Promise((go) => setTimeout(go, 50))");
  EXPECT_EQ(run("return getSelection().toString()"), "chainreel verify 'arm <suite>.yaml' --accept reach");
}

TEST_F(VerifyPage, OpensThePictureThatItsAddressNames) {
  browser_->open("about:blank");
  browser_->open("file://" + page() + "#picture-3");
  EXPECT_EQ(shown_name(), "wide");
}

TEST_F(VerifyPage, IsReadableAtDeskAndPhoneInLightAndDark) {
  const std::string pictures = CHAINREEL_BINARY_FOLDER "/verify_";
  for (const int width : {1280, 390})
    for (const bool dark : {false, true}) {
      browser_->resize(width, 900);
      browser_->prefer_dark(dark);
      open();
      shown_images();
      browser_->run_async("for (let i = 0; i < 3; ++i) await new Promise(requestAnimationFrame)");
      const std::string name = std::to_string(width) + (dark ? "_dark" : "_light");
      const Image image = browser_->screenshot(pictures + name + ".png");
      EXPECT_EQ(image.width, width) << name;
      EXPECT_EQ(run("return scrollY"), 0) << "a page begins at its head";
      EXPECT_EQ(image.at(3, 3), dark ? (Pixel{0x14, 0x17, 0x1C, 255}) : (Pixel{255, 255, 255, 255})) << name;
      EXPECT_LE(run("return document.documentElement.scrollWidth").get<int>(), width) << name;
      for (const char* key : {"l", "b", "d", "z"}) {
        press(key);
        shown_images();
        if (width == 390) browser_->screenshot(pictures + name + "_" + key + ".png");
        EXPECT_LE(run("return document.documentElement.scrollWidth").get<int>(), width) << name << key;
      }
      press("z");
    }
  browser_->prefer_dark(false);
}

TEST_F(VerifyPage, HoldsHundredsOfPicturesAndDecodesFew) {
  VerifyReport report = small_report();
  const std::vector<ReportPicture> few = report.pictures;
  for (int k = 0; k < 400; ++k) {
    report.pictures.push_back(few[1]);
    report.pictures.back().name = "pose " + std::to_string(k);
  }
  const std::string many = folder_->file("many.html");
  write_html_report(many, report, false);
  browser_->open("file://" + many);
  browser_->run_async("for (let i = 0; i < 5; ++i) await new Promise(requestAnimationFrame)");
  EXPECT_EQ(run("return all('#list li').length"), 406);
  EXPECT_LE(run("return all('.thumb').filter((t) => t.style.backgroundImage).length").get<int>(), 60);
  EXPECT_GE(run("return all('.thumb').filter((t) => t.style.backgroundImage).length").get<int>(), 3);
  EXPECT_EQ(run("return all('main img').length"), 3);
  EXPECT_THAT(browser_->complaints(), IsEmpty());
}

TEST_F(VerifyPage, OfASuiteThatPassedOffersNothingToAccept) {
  VerifyReport report = small_report();
  report.accept_command.clear();
  std::erase_if(report.pictures, [](const ReportPicture& p) { return !p.passes; });
  const std::string good = folder_->file("good.html"), none = folder_->file("none.html");
  write_html_report(good, report, false);
  browser_->open("file://" + good);
  EXPECT_EQ(run("return $('#summary').textContent"), "2 pictures passed");
  EXPECT_EQ(run("return all('.command').length"), 0);
  report.pictures.clear();
  write_html_report(none, report, false);
  browser_->open("file://" + none);
  EXPECT_EQ(shown_name(), nullptr);
  press("jkasldbz");
  EXPECT_THAT(browser_->complaints(), IsEmpty());
}

TEST_F(VerifyPage, IsNotWrittenOverAnotherFile) {
  const std::string mine = folder_->write("mine.html", "mine");
  EXPECT_THROW(write_html_report(mine, small_report(), false), Error);
  EXPECT_EQ(read_whole_file(mine), "mine");
}

// Negative control: the same check finds what is wrong on purpose.
TEST_F(VerifyPage, CheckFindsErrorsAndRequests) {
  std::string text = read_whole_file(page());
  text.replace(text.find("</main>"), 7,
               "</main><script>noSuchFunction();</script><img alt=\"\" src=\"https://example.org/a.png\">");
  const auto problems = problems_of_page(*browser_, folder_->write("loud.html", text), {});
  EXPECT_THAT(problems, Contains(HasSubstr("noSuchFunction is not defined")));
  EXPECT_THAT(problems, Contains(HasSubstr("Content Security Policy")));
}

}  // namespace
}  // namespace chainreel
