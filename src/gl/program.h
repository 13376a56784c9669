#pragma once

#include "gl/objects.h"
#include "gl/shader_source.h"

#include <string>
#include <string_view>
#include <vector>

namespace isoglass::gl {

void destroyProgram(GLuint name);

/// A linked vertex and fragment shader.
class Program : public Handle<destroyProgram> {
  public:
    /// Files of shaders/. Throws Error with the shader's name and the compiler's log, in which source
    /// numbers stand beside the names of the files. `defines` go in front of the fragment shader, each a
    /// name, or a name, a space and its value.
    Program(std::string_view vertexFile, std::string_view fragmentFile,
            const std::vector<std::string>& defines = {});
    /// The same for sources from elsewhere; `label` names the program in errors.
    Program(const std::string& label, const ShaderSource& vertex, const ShaderSource& fragment);

    /// Texture units of the samplers that the shaders read, increasing.
    std::vector<int> samplerUnits() const;
    /// Units of the images that the shaders read or write, increasing.
    std::vector<int> imageUnits() const;
    /// Bindings of the storage blocks that the shaders read or write, increasing.
    std::vector<int> storageBindings() const;
    /// Locations of the fragment outputs, increasing.
    std::vector<int> outputLocations() const;

  private:
    std::vector<int> unitsOf(bool (*isWanted)(GLenum type)) const;
};

}  // namespace isoglass::gl
