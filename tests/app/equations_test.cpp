// `equations`: its Python is that which it prints, and says what `dynamics` says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Debian's own, which has its packages.
constexpr const char* kPython = "/usr/bin/python3";

// M, C qd + g, J and Lambda from the module in one state, as JSON.
const char* const kProbe =
    "import json, importlib.util as u\n"
    "s = u.spec_from_file_location('m', 'MODULE'); m = u.module_from_spec(s); s.loader.exec_module(m)\n"
    "import numpy as np\n"
    "q, qd, tau = np.array([Q]), np.array([QD]), np.array([TAU])\n"
    "print(json.dumps({'M': m.M(q).tolist(), 'nle': (m.C(q, qd) @ qd + m.g(q)).tolist(), 'J': m.J(q).tolist(),\n"
    "  'Lambda': m.Lambda(q).tolist(), 'qdd': m.forward(q, qd, tau).tolist()}))\n";

std::string once_replaced(std::string text, const std::string& word, const std::string& by) {
  return text.replace(text.find(word), word.size(), by);
}

void expect_near(const Json& a, const Json& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].is_array())
      expect_near(a[i], b[i], what);
    else  // some hundred roundings of numbers up to 100
      EXPECT_NEAR(a[i].get<double>(), b[i].get<double>(), 1e-10 * (1 + std::abs(b[i].get<double>()))) << what;
}

TEST(Equations, HoldThePartsThatAreAskedForAndLongSumsOnSeveralLines) {
  const std::string m = run_program({"equations", "models/rrr.urdf", "--latex", "--only", "M"}).out;
  EXPECT_THAT(m, Not(HasSubstr("\\tau = M("))) << "what was not asked for";
  EXPECT_THAT(run_program({"equations", "models/rrr.urdf", "--latex", "--only", "equation,M"}).out, AllOf(HasSubstr("\\tau = M("), HasSubstr("M &="), Not(HasSubstr("C_{11}"))));
  EXPECT_THAT(run_program({"equations", "models/rrr.urdf", "--only", "equation,M"}).err, HasSubstr("holds C, g, which --only leaves out: --only equation,M,C,g"));
  EXPECT_EQ(run_program({"equations", "models/rrr.urdf", "--only", "equation,M,C,g"}).err, "");
  EXPECT_THAT(m, HasSubstr("M &= \\begin{bmatrix} M_{11} & M_{12} & M_{13} \\\\ M_{12} & M_{22} & M_{23}"));
  EXPECT_THAT(m, HasSubstr("M_{11} &="));
  EXPECT_THAT(m, testing::Not(HasSubstr("gravity"))) << "M knows nothing of it";
  EXPECT_THAT(m, HasSubstr("\\\\\n  &\\quad + "));
  for (const char* other : {"C_{11}", "g(q)", "J_{11}", "\\Lambda", "\\tau"}) EXPECT_THAT(m, testing::Not(HasSubstr(other)));
  std::istringstream lines(m);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 175u) << line;
  const std::string g = run_program({"equations", "models/rrr.urdf", "--only", "g,J"}).out;
  EXPECT_THAT(g, testing::AllOf(HasSubstr("\ng(q):\n"), HasSubstr("\nJ(q)"), testing::Not(HasSubstr("M_11")), testing::Not(HasSubstr("Lambda"))));
  EXPECT_THAT(run_program({"equations", "models/rrr.urdf", "--only", "m"}).err, HasSubstr("did you mean 'M'?"));
  EXPECT_EQ(run_program({"equations", "models/rrr.urdf", "--only", "M", "--python"}).status, 2);
}

TEST(Equations, AsPythonSayWhatDynamicsSays) {
  if (!std::filesystem::exists(kPython)) GTEST_SKIP() << "needs Debian's python3 with python3-numpy";
  const struct {
    const char *model, *q, *qd, *tau;
  } cases[] = {{"rr", "0.3,1.1", "0.5,-2", "1,2"}, {"rrr", "0.3,1.1,-0.7", "0.5,-2,1", "1,2,-3"}, {"pp", "0.3,1.1", "0.5,-2", "1,2"}};
  for (const auto& c : cases) {
    const TemporaryFolder folder;
    const std::string model = std::string("models/") + c.model + ".urdf", module = folder.file("m.py");
    ASSERT_EQ(run_program({"equations", model, "--python", "-o", module}).status, 0);
    folder.write("probe.py", once_replaced(once_replaced(once_replaced(once_replaced(kProbe, "MODULE", module), "[Q]", "[" + std::string(c.q) + "]"), "[QD]",
                                               "[" + std::string(c.qd) + "]"),
                                      "[TAU]", "[" + std::string(c.tau) + "]"));
    const ProgramResult said = run_command({kPython, folder.file("probe.py")});
    ASSERT_EQ(said.status, 0) << said.err;
    const Json python = Json::parse(said.out);
    const Json numbers = Json::parse(run_program({"dynamics", model, "--q=" + std::string(c.q), "--qd=" + std::string(c.qd),
                                                  "--tau=" + std::string(c.tau), "--json"})
                                         .out);
    for (const char* key : {"M", "nle", "J", "Lambda", "qdd"}) expect_near(python[key], numbers[key], c.model + std::string(" ") + key);
  }
}

// Where dynamics has no Lambda, of one joint nowhere and of two where the arm is stretched or folded, Python has none.
TEST(Equations, AsPythonSayWhereThereIsNoLambda) {
  if (!std::filesystem::exists(kPython)) GTEST_SKIP() << "needs Debian's python3 with python3-numpy";
  const TemporaryFolder folder;
  const auto lambda_at = [&](const std::string& model, const std::string& q) {
    EXPECT_EQ(run_program({"equations", model, "--python", "-o", folder.file("m.py"), "--force"}).status, 0);
    folder.write("probe.py", "import sys\nsys.path.insert(0, '" + folder.file("") + "')\nimport numpy as np, m\n"
                             "try: print(m.Lambda(np.array([" + q + "])))\nexcept ValueError as e: print('refused', e)\n");
    return run_command({kPython, "-B", folder.file("probe.py")}).out;
  };
  const std::string one = folder.write("one.yaml", "model: {links: [0.5], masses: [1], joints: R}\n"), two = "models/rr.urdf";
  for (const char* q : {"0", "0.3", "0.7", "1.5"})
    EXPECT_THAT(lambda_at(one, q), HasSubstr("refused no Lambda at this pose: the effective mass of")) << q;
  for (const char* q : {"0.3, 0", "0.3, 3.141592653589793"}) EXPECT_THAT(lambda_at(two, q), HasSubstr("refused")) << q;
  EXPECT_THAT(lambda_at(two, "0.3, 1.1"), testing::Not(HasSubstr("refused"))) << "negative control";
}

TEST(Equations, TakeWhatASceneSaysOfItsMechanism) {
  const ProgramResult pen = run_program({"equations", "assets/scenes/pen.yaml"});
  EXPECT_EQ(pen.status, 0) << pen.err;
  EXPECT_THAT(pen.out, HasSubstr("the scene's constraints are not in it"));
  const ProgramResult down = run_program({"equations", "models/rr.urdf", "--gravity", "0,0,0", "--json"});
  EXPECT_EQ(Json::parse(down.out)["g"], Json({"0", "0"}));
}

TEST(Equations, GoIntoAsManyFilesAsAreNamedOrIntoNone) {
  const TemporaryFolder folder;
  const std::string tex = folder.file("a.tex"), py = folder.file("a.py"), text = folder.file("a.txt");
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "-o", tex, "-o", py, "--theta"}).status, 0);
  EXPECT_THAT(read_whole_file(tex), HasSubstr("\\theta_{2}"));
  EXPECT_THAT(read_whole_file(py), AllOf(HasSubstr("def J(q)"), HasSubstr("along x, y"), testing::Not(HasSubstr("theta"))));
  // One of them exists, one is named twice, one has no form: nothing is written.
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "-o", text, "-o", py}).status, 6);
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "-o", text, "-o", text}).status, 2);
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "-o", text, "-o", folder.file("./a.txt")}).status, 2);
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "-o", text, "-o", folder.file("a.png")}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(text));
}

TEST(Equations, AreADocumentWhereItIsAskedFor) {
  const TemporaryFolder folder;
  const std::string tex = folder.file("rr.tex");
  ASSERT_EQ(run_program({"equations", "models/rr.urdf", "--document", "-o", tex}).status, 0);
  EXPECT_THAT(read_whole_file(tex), HasSubstr("\\documentclass"));
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "--document"}).out, read_whole_file(tex));
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "--document", "--latex"}).out, read_whole_file(tex));
  // Beside other forms it speaks of the .tex alone; without one of nothing.
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "--document", "-o", folder.file("b.tex"), "-o", folder.file("b.py")}).status, 0);
  EXPECT_THAT(read_whole_file(folder.file("b.py")), HasSubstr("import numpy"));
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "--document", "-o", folder.file("c.py")}).status, 2);
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "--document", "--python"}).status, 2);
}

TEST(Equations, RefuseWhatTheyCannotSay) {
  EXPECT_THAT(run_program({"equations", "models/arm.urdf"}).err, AllOf(HasSubstr("1 to 4 joints"), HasSubstr("chainreel dynamics")));
  EXPECT_EQ(run_program({"equations", "models/arm.urdf"}).status, 3);
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "--latex", "--python"}).status, 2);
  EXPECT_EQ(run_program({"equations", "models/rr.urdf", "--python", "--theta"}).status, 2);
}

}  // namespace
}  // namespace chainreel
