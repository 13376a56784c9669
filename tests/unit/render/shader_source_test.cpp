#include "gl/shader_source.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <map>

namespace isoglass::gl {
namespace {

ShaderSource resolve(const std::map<std::string, std::string, std::less<>>& files) {
    return resolveIncludes("main.frag", [&files](std::string_view name) -> std::string_view {
        const auto found = files.find(name);
        if (found == files.end()) throw Error("no such shader file", std::string(name));
        return found->second;
    });
}

TEST(ShaderSource, IncludesArePutInAndLineNumbersRestored) {
    const ShaderSource source =
        resolve({{"main.frag", "#version 450\n#include \"lib/a.glsl\"\nvoid main() {}\n"},
                 {"lib/a.glsl", "float a;\n"}});
    EXPECT_EQ(source.text, "#version 450\n#line 1 1\nfloat a;\n#line 3 0\nvoid main() {}\n");
    EXPECT_EQ(source.files, (std::vector<std::string>{"main.frag", "lib/a.glsl"}));
}

TEST(ShaderSource, AFileIsPutInOnce) {
    const ShaderSource source = resolve({{"main.frag", "#include \"lib/a.glsl\"\n#include \"lib/b.glsl\"\n"},
                                         {"lib/a.glsl", "#include \"lib/b.glsl\"\nfloat a;\n"},
                                         {"lib/b.glsl", "float b;\n"}});
    EXPECT_EQ(source.text, "#line 1 1\n#line 1 2\nfloat b;\n#line 2 1\nfloat a;\n#line 2 0\n#line 3 0\n");
}

TEST(ShaderSource, ACycleEnds) {
    const ShaderSource source =
        resolve({{"main.frag", "#include \"lib/a.glsl\"\n"}, {"lib/a.glsl", "#include \"lib/a.glsl\"\n"}});
    EXPECT_EQ(source.files.size(), 2u);
}

TEST(ShaderSource, AnUnknownIncludeIsAnError) {
    EXPECT_THROW(resolve({{"main.frag", "#include \"lib/none.glsl\"\n"}}), Error);
}

TEST(ShaderSource, AnIncludeWithoutQuotesSaysWhere) {
    try {
        resolve({{"main.frag", "float x;\n#include <lib/a.glsl>\n"}});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "main.frag:2");
    }
}

TEST(ShaderSource, EmbeddedFilesAreFoundByName) {
    EXPECT_TRUE(embeddedShader("opaque.frag").starts_with("#version 450 core\n"));
    EXPECT_NE(embeddedShader("lib/position.glsl").find("invariant gl_Position"), std::string_view::npos);
    EXPECT_THROW(embeddedShader("none.frag"), Error);
}

}  // namespace
}  // namespace isoglass::gl
