#include "render/pass.h"

#include "render_fixture.h"

#include <stdexcept>

namespace isoglass::test {
namespace {

std::vector<PassDeclaration> passesFor(TransparencyMethod method, bool separate = false) {
    return declarePasses(planFrame({1, 1, method, separate}));
}

const std::vector<std::vector<PassDeclaration>> everyList() {
    return {passesFor(TransparencyMethod::threePass), passesFor(TransparencyMethod::threePass, true),
            passesFor(TransparencyMethod::fourPass), declarePasses(planFrame({1, 0}))};
}

using Passes = RenderTest;

TEST_F(Passes, EachDeclaresWhatItsShadersReadAndWrite) {
    for (const auto& passes : everyList()) {
        for (const PassDeclaration& pass : passes) {
            EXPECT_NO_THROW(checkInterface(pass, gl::Program(pass.vertexShader, pass.fragmentShader)));
        }
    }
}

TEST_F(Passes, ReadingAnUndeclaredTargetIsFound) {
    PassDeclaration pass = passesFor(TransparencyMethod::fourPass).back();
    const gl::Program program(pass.vertexShader, pass.fragmentShader);
    pass.reads.pop_back();
    EXPECT_THROW(checkInterface(pass, program), std::logic_error);
}

TEST_F(Passes, WritingAnUndeclaredTargetIsFound) {
    PassDeclaration pass = passesFor(TransparencyMethod::fourPass).back();
    const gl::Program program(pass.vertexShader, pass.fragmentShader);
    pass.writes.pop_back();
    EXPECT_THROW(checkInterface(pass, program), std::logic_error);
}

TEST(PassList, DataFlowsFromEarlierToLaterPasses) {
    for (const auto& passes : everyList()) EXPECT_NO_THROW(checkDataFlow(passes));
}

TEST(PassList, AMissingPassIsFound) {
    // Without any one pass but the last, something reads what nobody wrote.
    for (const auto& passes : everyList()) {
        for (std::size_t left = 0; left + 1 < passes.size(); ++left) {
            std::vector<PassDeclaration> fewer = passes;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(left));
            EXPECT_THROW(checkDataFlow(fewer), std::logic_error) << passName(passes[left].kind);
        }
    }
}

TEST(PassList, ReadingWhatThePassWritesIsFound) {
    auto passes = passesFor(TransparencyMethod::threePass);
    passes.back().reads.push_back(Target::linearImage);
    EXPECT_THROW(checkDataFlow(passes), std::logic_error);
}

TEST(PassList, OnlyTheOpaquePassWritesTheOpaqueDepth) {
    for (const auto& passes : everyList()) {
        for (const PassDeclaration& pass : passes) {
            if (pass.kind == PassKind::opaque || !pass.depth) continue;
            EXPECT_FALSE(pass.state.depthWrite && pass.depth->target == Target::opaqueDepth)
                << passName(pass.kind);
        }
    }
}

TEST(PassList, WireframeIsForSurfacesAndNotForTheWholeImage) {
    for (auto passes : everyList()) {
        drawWireframe(passes);
        for (const PassDeclaration& pass : passes) {
            EXPECT_EQ(pass.state.wireframe, pass.kind != PassKind::resolve) << passName(pass.kind);
        }
    }
}

}  // namespace
}  // namespace isoglass::test
