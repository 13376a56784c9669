#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isoglass::gl {

/// A GLSL file of the folder shaders/, embedded at build time.
struct ShaderFile {
    std::string_view name;  ///< relative to shaders/, e.g. "lib/srgb.glsl"
    std::string_view text;
};

/// All embedded files by increasing name.
std::span<const ShaderFile> embeddedShaders();

/// Text of an embedded file. Throws Error where there is none of that name.
std::string_view embeddedShader(std::string_view name);

/// One stage's source after its includes were put in.
struct ShaderSource {
    std::string text;
    /// Which file a `#line` source number stands for: number i is files[i], 0 the entry file.
    std::vector<std::string> files;
};

/// Replaces each line `#include "NAME"` by the text that `lookup(NAME)` gives. Names are relative to
/// shaders/ wherever the line stands, a file is put in once, and `#line` keeps the compiler's line
/// numbers those of the files. Throws Error for an include line that cannot be read; `lookup` throws
/// for a name that it does not know.
ShaderSource resolveIncludes(std::string_view entry,
                             const std::function<std::string_view(std::string_view)>& lookup);

}  // namespace isoglass::gl
