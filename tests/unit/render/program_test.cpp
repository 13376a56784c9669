#include "gl/program.h"

#include "base/error.h"
#include "render/uniforms.h"
#include "render_fixture.h"

#include <cstddef>

namespace isoglass::test {
namespace {

using ProgramTest = GlTest;

const gl::ShaderSource kVertex{"#version 450 core\nvoid main() { gl_Position = vec4(0); }\n", {"any.vert"}};

TEST_F(ProgramTest, ACompileErrorNamesTheFilesAndTheLog) {
    const gl::ShaderSource wrong{"#version 450 core\n#line 7 1\nvoid main() { nonsense; }\n",
                                 {"main.frag", "lib/a.glsl"}};
    try {
        gl::Program("test", kVertex, wrong);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "0 = main.frag, 1 = lib/a.glsl");
        EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("7"), std::string::npos) << error.what();
    }
    context_.debugLog().take();
}

TEST_F(ProgramTest, ALinkErrorNamesTheProgram) {
    const gl::ShaderSource wrong{
        "#version 450 core\nin vec3 missing;\nlayout(location = 0) out vec4 c;\nvoid main() { c = "
        "missing.xyzz; }\n",
        {"main.frag"}};
    try {
        gl::Program("test program", kVertex, wrong);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "test program");
    }
    context_.debugLog().take();
}

TEST_F(ProgramTest, ReflectionTellsSamplersAndOutputs) {
    const gl::Program program("full_screen.vert", "resolve_composed.frag", {"OPAQUE_BEHIND"});
    EXPECT_EQ(program.samplerUnits(), (std::vector<int>{0, 2}));
    EXPECT_EQ(program.outputLocations(), std::vector<int>{0});
    EXPECT_EQ(gl::Program("full_screen.vert", "resolve_composed.frag").samplerUnits(), std::vector<int>{2});
}

TEST_F(ProgramTest, ReflectionTellsImagesAndStorage) {
    const gl::Program lists("surface.vert", "fragment_lists.frag");
    EXPECT_EQ(lists.imageUnits(), std::vector<int>{0});
    EXPECT_EQ(lists.storageBindings(), std::vector<int>{0});
    EXPECT_TRUE(lists.samplerUnits().empty());
}

/// The block of the fragment lists is that of its mirror.
TEST_F(ProgramTest, NodesOfTheFragmentListsAreThoseOfTheMirror) {
    const gl::Program program("surface.vert", "fragment_lists.frag");
    const auto value = [&](const char* variable, GLenum what) {
        const GLuint index = glGetProgramResourceIndex(program.name(), GL_BUFFER_VARIABLE, variable);
        EXPECT_NE(index, GL_INVALID_INDEX) << variable;
        GLint result = -1;
        glGetProgramResourceiv(program.name(), GL_BUFFER_VARIABLE, index, 1, &what, 1, nullptr, &result);
        return result;
    };
    EXPECT_EQ(value("nodeCount", GL_OFFSET), 0);
    EXPECT_EQ(value("nodeCapacity", GL_OFFSET), 4);
    EXPECT_EQ(value("nodes[0].red", GL_OFFSET), static_cast<GLint>(FragmentLists::kHeaderBytes));
    EXPECT_EQ(value("nodes[0].red", GL_TOP_LEVEL_ARRAY_STRIDE),
              static_cast<GLint>(FragmentLists::kNodeBytes));
}

/// What the driver says of a member of a uniform block.
GLint memberProperty(const gl::Program& program, const char* member, GLenum what) {
    const GLuint index = glGetProgramResourceIndex(program.name(), GL_UNIFORM, member);
    EXPECT_NE(index, GL_INVALID_INDEX) << member;
    GLint value = -1;
    glGetProgramResourceiv(program.name(), GL_UNIFORM, index, 1, &what, 1, nullptr, &value);
    return value;
}

void expectOffset(const gl::Program& program, const char* member, std::size_t offset) {
    EXPECT_EQ(memberProperty(program, member, GL_OFFSET), static_cast<GLint>(offset)) << member;
}

void expectBlock(const gl::Program& program, const char* block, unsigned binding, std::size_t size) {
    const GLuint index = glGetProgramResourceIndex(program.name(), GL_UNIFORM_BLOCK, block);
    ASSERT_NE(index, GL_INVALID_INDEX) << block;
    const GLenum what[] = {GL_BUFFER_BINDING, GL_BUFFER_DATA_SIZE};
    GLint values[2] = {-1, -1};
    glGetProgramResourceiv(program.name(), GL_UNIFORM_BLOCK, index, 2, what, 2, nullptr, values);
    EXPECT_EQ(values[0], static_cast<GLint>(binding)) << block;
    EXPECT_EQ(values[1], static_cast<GLint>(size)) << block;
}

TEST_F(ProgramTest, UniformLayoutsAreThoseOfTheMirrors) {
    const gl::Program surface("surface.vert", "attenuation_and_emission.frag");
    expectBlock(surface, "Draw", DrawUniforms::kBinding, sizeof(DrawUniforms));
    expectOffset(surface, "clipFromMesh", offsetof(DrawUniforms, clipFromMesh));
    expectOffset(surface, "eyeFromMesh", offsetof(DrawUniforms, eyeFromMesh));
    expectOffset(surface, "normalFromMesh", offsetof(DrawUniforms, normalFromMesh));
    expectOffset(surface, "colorOpacity", offsetof(DrawUniforms, colorOpacity));
    expectOffset(surface, "opacityModel", offsetof(DrawUniforms, opacityModel));
    expectOffset(surface, "gradientScale", offsetof(DrawUniforms, gradientScale));
    expectOffset(surface, "depthScale", offsetof(DrawUniforms, depthScale));
    expectOffset(surface, "colorScale", offsetof(DrawUniforms, colorScale));
    expectOffset(surface, "motion", offsetof(DrawUniforms, motion));
    expectOffset(surface, "motionLimit", offsetof(DrawUniforms, motionLimit));
    expectBlock(surface, "ColorMap", ColorMapUniforms::kBinding, sizeof(ColorMapUniforms));
    EXPECT_EQ(memberProperty(surface, "normalFromMesh", GL_MATRIX_STRIDE),
              static_cast<GLint>(sizeof(DrawUniforms::normalFromMesh[0])));

    expectBlock(surface, "Frame", FrameUniforms::kBinding, sizeof(FrameUniforms));
    expectOffset(surface, "ambient", offsetof(FrameUniforms, ambient));
    expectOffset(surface, "diffuse", offsetof(FrameUniforms, diffuse));
    expectOffset(surface, "specular", offsetof(FrameUniforms, specular));
    expectOffset(surface, "shininess", offsetof(FrameUniforms, shininess));
    const gl::Program resolve("full_screen.vert", "resolve_lists.frag");
    expectOffset(resolve, "exposure", offsetof(FrameUniforms, exposure));
    expectOffset(resolve, "background", offsetof(FrameUniforms, background));
    expectOffset(resolve, "layerLimit", offsetof(FrameUniforms, layerLimit));
    const gl::Program drawing("full_screen.vert", "illustration.frag", {"SUPERSAMPLE 1", "SURFACES"});
    expectBlock(drawing, "Illustration", IllustrationUniforms::kBinding, sizeof(IllustrationUniforms));
    expectOffset(drawing, "frontColor", offsetof(IllustrationUniforms, frontColor));
    expectOffset(drawing, "hatchRow", offsetof(IllustrationUniforms, hatchRow));
    expectOffset(drawing, "shiftPixels", offsetof(IllustrationUniforms, shiftPixels));
    expectOffset(drawing, "normalThreshold", offsetof(IllustrationUniforms, normalThreshold));
    expectOffset(drawing, "depthThreshold", offsetof(IllustrationUniforms, depthThreshold));
    const gl::Program medium("full_screen.vert", "volume.frag");
    expectBlock(medium, "Volume", VolumeUniforms::kBinding, sizeof(VolumeUniforms));
    expectOffset(medium, "planes", offsetof(VolumeUniforms, planes));
    expectOffset(medium, "stepCells", offsetof(VolumeUniforms, stepCells));
    expectOffset(medium, "transferLow", offsetof(VolumeUniforms, transferLow));
    expectOffset(medium, "litByGradient", offsetof(VolumeUniforms, litByGradient));
    const gl::Program present("full_screen.vert", "present.frag");
    expectOffset(present, "accumulationShare", offsetof(FrameUniforms, accumulationShare));
}

}  // namespace
}  // namespace isoglass::test
