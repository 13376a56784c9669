#include "gl/shader_source.h"

#include "base/error.h"

#include <algorithm>

namespace isoglass::gl {
namespace {

constexpr std::string_view kInclude = "#include";

std::string_view includedName(std::string_view line, const std::string& file, int lineNumber) {
    const std::size_t open = line.find('"');
    const std::size_t close = line.rfind('"');
    if (open == std::string_view::npos || close <= open + 1) {
        throw Error("an include line without a file name in quotes", file + ":" + std::to_string(lineNumber),
                    "write #include \"lib/NAME.glsl\"");
    }
    return line.substr(open + 1, close - open - 1);
}

class Resolver {
  public:
    explicit Resolver(const std::function<std::string_view(std::string_view)>& lookup) : lookup_(lookup) {}

    void append(std::string_view name) {
        const std::size_t number = source_.files.size();
        source_.files.emplace_back(name);
        std::string_view rest = lookup_(name);
        for (int line = 1; !rest.empty(); ++line) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            const std::string_view text = rest.substr(0, end);
            rest.remove_prefix(std::min(end + 1, rest.size()));
            if (text.starts_with(kInclude)) {
                include(includedName(text, std::string(name), line));
                source_.text += "#line " + std::to_string(line + 1) + " " + std::to_string(number) + "\n";
            } else {
                source_.text.append(text).push_back('\n');
            }
        }
    }

    ShaderSource take() { return std::move(source_); }

  private:
    void include(std::string_view name) {
        if (std::find(source_.files.begin(), source_.files.end(), name) != source_.files.end()) return;
        source_.text += "#line 1 " + std::to_string(source_.files.size()) + "\n";
        append(name);
    }

    const std::function<std::string_view(std::string_view)>& lookup_;
    ShaderSource source_;
};

}  // namespace

std::string_view embeddedShader(std::string_view name) {
    const std::span<const ShaderFile> files = embeddedShaders();
    const auto found =
        std::find_if(files.begin(), files.end(), [name](const auto& file) { return file.name == name; });
    if (found == files.end()) throw Error("no such shader file", std::string(name));
    return found->text;
}

ShaderSource resolveIncludes(std::string_view entry,
                             const std::function<std::string_view(std::string_view)>& lookup) {
    Resolver resolver(lookup);
    resolver.append(entry);
    return resolver.take();
}

}  // namespace isoglass::gl
