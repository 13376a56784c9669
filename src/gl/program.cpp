#include "gl/program.h"

#include "base/error.h"

#include <algorithm>

namespace isoglass::gl {
namespace {

void destroyShader(GLuint name) {
    glDeleteShader(name);
}

std::string fileNumbers(const ShaderSource& source) {
    std::string text;
    for (std::size_t i = 0; i < source.files.size(); ++i) {
        text += (i == 0 ? "" : ", ") + std::to_string(i) + " = " + source.files[i];
    }
    return text;
}

std::string trimmed(std::string log) {
    log.erase(log.find_last_not_of(std::string_view("\n \0", 3)) + 1);
    return log;
}

std::string shaderLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    return trimmed(log);
}

std::string programLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetProgramInfoLog(program, length, nullptr, log.data());
    return trimmed(log);
}

class Shader : public Handle<destroyShader> {
  public:
    Shader(GLenum stage, const ShaderSource& source) : Handle(glCreateShader(stage)) {
        const char* text = source.text.c_str();
        glShaderSource(name(), 1, &text, nullptr);
        glCompileShader(name());
        GLint compiled = GL_FALSE;
        glGetShaderiv(name(), GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_FALSE) {
            throw Error("the shader does not compile: " + shaderLog(name()), fileNumbers(source));
        }
    }
};

/// Calls `visit(resource index)` for each active resource of an interface.
template <typename Visit>
void forEachResource(GLuint program, GLenum interface, const Visit& visit) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; ++i) visit(static_cast<GLuint>(i));
}

GLint property(GLuint program, GLenum interface, GLuint index, GLenum what) {
    GLint value = 0;
    glGetProgramResourceiv(program, interface, index, 1, &what, 1, nullptr, &value);
    return value;
}

bool isSampler(GLenum type) {
    return type == GL_SAMPLER_2D || type == GL_SAMPLER_3D || type == GL_UNSIGNED_INT_SAMPLER_2D ||
           type == GL_UNSIGNED_INT_SAMPLER_2D_ARRAY;
}

bool isImage(GLenum type) {
    return type == GL_UNSIGNED_INT_IMAGE_2D || type == GL_UNSIGNED_INT_IMAGE_2D_ARRAY;
}

/// The defines go behind the line of the version, which must come first.
ShaderSource withDefines(ShaderSource source, const std::vector<std::string>& defines) {
    if (defines.empty()) return source;
    const std::size_t versionEnd = source.text.find('\n') + 1;
    std::string lines;
    for (const std::string& define : defines) lines += "#define " + define + "\n";
    source.text.insert(versionEnd, lines + "#line 2 0\n");
    return source;
}

}  // namespace

void destroyProgram(GLuint name) {
    glDeleteProgram(name);
}

Program::Program(std::string_view vertexFile, std::string_view fragmentFile,
                 const std::vector<std::string>& defines)
    : Program(std::string(vertexFile) + " with " + std::string(fragmentFile),
              resolveIncludes(vertexFile, embeddedShader),
              withDefines(resolveIncludes(fragmentFile, embeddedShader), defines)) {}

Program::Program(const std::string& label, const ShaderSource& vertex, const ShaderSource& fragment)
    : Handle(glCreateProgram()) {
    const Shader vertexShader(GL_VERTEX_SHADER, vertex);
    const Shader fragmentShader(GL_FRAGMENT_SHADER, fragment);
    glAttachShader(name(), vertexShader.name());
    glAttachShader(name(), fragmentShader.name());
    glLinkProgram(name());
    GLint linked = GL_FALSE;
    glGetProgramiv(name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) throw Error("the shaders do not link: " + programLog(name()), label);
    glDetachShader(name(), vertexShader.name());
    glDetachShader(name(), fragmentShader.name());
}

std::vector<int> Program::samplerUnits() const {
    return unitsOf(isSampler);
}

std::vector<int> Program::imageUnits() const {
    return unitsOf(isImage);
}

std::vector<int> Program::storageBindings() const {
    std::vector<int> bindings;
    forEachResource(name(), GL_SHADER_STORAGE_BLOCK, [&](GLuint index) {
        bindings.push_back(property(name(), GL_SHADER_STORAGE_BLOCK, index, GL_BUFFER_BINDING));
    });
    std::sort(bindings.begin(), bindings.end());
    return bindings;
}

std::vector<int> Program::unitsOf(bool (*isWanted)(GLenum type)) const {
    std::vector<int> units;
    forEachResource(name(), GL_UNIFORM, [&](GLuint index) {
        if (!isWanted(static_cast<GLenum>(property(name(), GL_UNIFORM, index, GL_TYPE)))) return;
        GLint unit = 0;
        glGetUniformiv(name(), property(name(), GL_UNIFORM, index, GL_LOCATION), &unit);
        units.push_back(unit);
    });
    std::sort(units.begin(), units.end());
    return units;
}

std::vector<int> Program::outputLocations() const {
    std::vector<int> locations;
    forEachResource(name(), GL_PROGRAM_OUTPUT, [&](GLuint index) {
        const int location = property(name(), GL_PROGRAM_OUTPUT, index, GL_LOCATION);
        if (location >= 0) locations.push_back(location);
    });
    std::sort(locations.begin(), locations.end());
    return locations;
}

}  // namespace isoglass::gl
