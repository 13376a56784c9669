#include "gl/debug_log.h"

#include "base/error.h"
#include "render_fixture.h"

#include <epoxy/gl.h>
#include <gtest/gtest-spi.h>

namespace isoglass::test {
namespace {

using DebugLogTest = GlTest;

TEST_F(DebugLogTest, AGlErrorIsRecordedAndTakenOnce) {
    glEnable(GL_COLOR_BUFFER_BIT);
    EXPECT_FALSE(context_.debugLog().take().empty());
    EXPECT_TRUE(context_.debugLog().take().empty());
}

TEST_F(DebugLogTest, AnErrorIsThrownWithThePlace) {
    glEnable(GL_COLOR_BUFFER_BIT);
    try {
        context_.debugLog().throwIfAny("frame");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "frame");
    }
    EXPECT_NO_THROW(context_.debugLog().throwIfAny("frame"));
}

void insert(GLenum type, GLenum severity) {
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, type, 1, severity, -1, "inserted");
}

TEST_F(DebugLogTest, TypesThatPointAtMistakesAndHighSeverityCount) {
    insert(GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, GL_DEBUG_SEVERITY_LOW);
    insert(GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR, GL_DEBUG_SEVERITY_LOW);
    insert(GL_DEBUG_TYPE_ERROR, GL_DEBUG_SEVERITY_LOW);
    insert(GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_HIGH);
    EXPECT_EQ(context_.debugLog().take(), std::vector<std::string>(4, "inserted"));
}

TEST_F(DebugLogTest, AdviceDoesNotCount) {
    insert(GL_DEBUG_TYPE_PERFORMANCE, GL_DEBUG_SEVERITY_MEDIUM);
    insert(GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_NOTIFICATION);
    EXPECT_TRUE(context_.debugLog().take().empty());
}

TEST_F(DebugLogTest, AFloodIsCountedNotKept) {
    for (std::size_t i = 0; i < gl::DebugLog::kMostMessages + 5; ++i) context_.debugLog().record("x");
    const std::vector<std::string> taken = context_.debugLog().take();
    ASSERT_EQ(taken.size(), gl::DebugLog::kMostMessages + 1);
    EXPECT_EQ(taken.back(), "5 more messages");
}

/// A test that makes a mistake, run by hand.
class Careless : public GlTest {
  public:
    void TestBody() override { glEnable(GL_COLOR_BUFFER_BIT); }
    void tearDown() { TearDown(); }
};

void runCareless() {
    Careless test;
    test.TestBody();
    test.tearDown();
}

TEST(GlFixture, FailsATestThatProvokesAGlError) {
    EXPECT_NONFATAL_FAILURE(runCareless(), "OpenGL on");
}

}  // namespace
}  // namespace isoglass::test
