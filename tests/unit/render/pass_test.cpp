#include "render/pass.h"

#include "render_fixture.h"

#include <stdexcept>

namespace isoglass::test {
namespace {

using enum TransparencyMethod;

std::vector<PassDeclaration> passesFor(TransparencyMethod method) {
    return declarePasses(
        planFrame({.opaqueSurfaces = 1, .semiTransparentSurfaces = 1, .method = method, .layers = 3}));
}

/// Every method with and without opaque surfaces, integer sums, linear image and supersampling.
std::vector<std::vector<PassDeclaration>> everyList() {
    std::vector<std::vector<PassDeclaration>> lists;
    for (const TransparencyMethod method : {twoPass, threePass, fourPass, peel, exact}) {
        for (int bits = 0; bits < 32; ++bits) {
            const PlanInput input{.opaqueSurfaces = bits & 1,
                                  .semiTransparentSurfaces = bits >> 1 & 1,
                                  .method = method,
                                  .layers = 3,
                                  .reproducible = (bits & 4) != 0,
                                  .samples = (bits & 8) != 0 ? 4 : 1,
                                  .keepLinear = (bits & 16) != 0};
            lists.push_back(declarePasses(planFrame(input)));
        }
    }
    return lists;
}

using Passes = RenderTest;

TEST_F(Passes, EachDeclaresWhatItsShadersReadAndWrite) {
    for (const auto& passes : everyList()) {
        for (const PassDeclaration& pass : passes) {
            const gl::Program program(pass.vertexShader, pass.fragmentShader, pass.defines);
            EXPECT_NO_THROW(checkInterface(pass, program)) << pass.fragmentShader;
        }
    }
}

TEST_F(Passes, ReadingAnUndeclaredTargetIsFound) {
    PassDeclaration pass = passesFor(fourPass).back();
    const gl::Program program(pass.vertexShader, pass.fragmentShader, pass.defines);
    pass.reads.pop_back();
    EXPECT_THROW(checkInterface(pass, program), std::logic_error);
}

TEST_F(Passes, WritingAnUndeclaredTargetIsFound) {
    PassDeclaration pass = passesFor(fourPass).back();
    const gl::Program program(pass.vertexShader, pass.fragmentShader, pass.defines);
    pass.writes.pop_back();
    EXPECT_THROW(checkInterface(pass, program), std::logic_error);
}

TEST_F(Passes, UsingUndeclaredImagesOrStorageIsFound) {
    PassDeclaration pass = passesFor(exact)[1];
    const gl::Program program(pass.vertexShader, pass.fragmentShader, pass.defines);
    ASSERT_NO_THROW(checkInterface(pass, program));
    pass.image = Target::sums;
    EXPECT_THROW(checkInterface(pass, program), std::logic_error);
    pass.image.reset();
    EXPECT_THROW(checkInterface(pass, program), std::logic_error);
}

TEST(PassList, DataFlowsFromEarlierToLaterPasses) {
    for (const auto& passes : everyList()) EXPECT_NO_THROW(checkDataFlow(passes));
}

TEST(PassList, AMissingPassIsFound) {
    // Without any one pass but the last, something reads what nobody wrote.
    for (const auto& passes : everyList()) {
        for (std::size_t left = 0; left + 1 < passes.size(); ++left) {
            // Without a farther layer the picture lacks it, but nothing else.
            if (passes[left].planned.layer > 0) continue;
            std::vector<PassDeclaration> fewer = passes;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(left));
            EXPECT_THROW(checkDataFlow(fewer), std::logic_error) << passLabel(passes[left].planned);
        }
    }
}

TEST(PassList, ReadingWhatThePassWritesIsFound) {
    auto passes = passesFor(threePass);
    passes.back().reads.push_back(Target::srgbImage);
    EXPECT_THROW(checkDataFlow(passes), std::logic_error);
}

TEST(PassList, OnlyTheOpaquePassWritesTheOpaqueDepth) {
    for (const auto& passes : everyList()) {
        for (const PassDeclaration& pass : passes) {
            if (pass.planned.kind == PassKind::opaque || !pass.depth) continue;
            EXPECT_FALSE(pass.state.depthWrite && pass.depth->target == Target::opaqueDepth)
                << passLabel(pass.planned);
        }
    }
}

TEST(PassList, WireframeIsForSurfacesAndNotForTheWholeImage) {
    for (auto passes : everyList()) {
        drawWireframe(passes);
        for (const PassDeclaration& pass : passes) {
            const bool overSurfaces = pass.vertexShader != std::string_view("full_screen.vert");
            EXPECT_EQ(pass.state.wireframe, overSurfaces) << passLabel(pass.planned);
        }
    }
}

}  // namespace
}  // namespace isoglass::test
