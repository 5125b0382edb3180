// The context, its functions and its errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.hpp"
#include "render/gl_context.hpp"
#include "render/gl_objects.hpp"

namespace chainreel {
namespace {

using testing::HasSubstr;

TEST(GlContext, ErrorsOfOpenGlBecomeErrorsOfOurs) {
  const auto context = create_gl_context();
  EXPECT_NO_THROW(check_gl(context->gl(), "nothing"));
  context->gl().Enable(0xDEAD);
  try {
    check_gl(context->gl(), "testing");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_renderer);
    EXPECT_THAT(error.what(), HasSubstr("testing"));
    EXPECT_THAT(error.what(), HasSubstr("GL_INVALID_ENUM"));
  }
  EXPECT_NO_THROW(check_gl(context->gl(), "nothing"));
}

TEST(GlContext, SeveralLiveSideBySide) {
  const auto one = create_gl_context(), other = create_gl_context();
  one->make_current();
  Target target(one->gl(), Target::Kind::color, 4, 4);
  other->make_current();
  Target other_target(other->gl(), Target::Kind::coverage, 4, 4);
  EXPECT_NO_THROW(check_gl(other->gl(), "switching"));
  one->make_current();
  EXPECT_NO_THROW(check_gl(one->gl(), "switching"));
}

TEST(GlContext, AMissingFunctionIsNamed) {
  try {
    load_gl_functions([](const char*) -> void (*)() { return nullptr; });
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_renderer);
    EXPECT_THAT(error.what(), HasSubstr("gl"));
  }
}

TEST(GlContext, AnUnknownShaderIsNamed) {
  const auto context = create_gl_context();
  EXPECT_THROW(PrimitiveProgram(context->gl(), "hexagon", 1, 8, 8), Error);
  EXPECT_NO_THROW(PrimitiveProgram(context->gl(), "capsule", 5, 8, 8));
}

TEST(GlContext, ShadersAreEmbeddedWhole) {
  for (int i = 0; i < kEmbeddedShaderCount; ++i) {
    EXPECT_FALSE(kEmbeddedShaders[i].source.empty()) << kEmbeddedShaders[i].name;
    EXPECT_EQ(kEmbeddedShaders[i].source.back(), '\n') << kEmbeddedShaders[i].name;
  }
}

TEST(GlContext, FlatPicturesAreDrawnByTheCallingThreadUnlessTheUserSaysOtherwise) {
  create_gl_context();
  ASSERT_NE(std::getenv("LP_NUM_THREADS"), nullptr);
}

}  // namespace
}  // namespace chainreel
