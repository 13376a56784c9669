#pragma once

#include <epoxy/gl.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace isoglass::gl {

/// Owner of one GL object: move-only, deletes it at the end. Made and destroyed in the thread in which
/// the context is current. `Destroy` is the delete call for one name.
template <void (*Destroy)(GLuint)>
class Handle {
  public:
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (name_ != 0) Destroy(name_);
    }

    GLuint name() const { return name_; }

  protected:
    explicit Handle(GLuint name) : name_(name) {}

  private:
    GLuint name_;
};

void destroyBuffer(GLuint name);
void destroyTexture(GLuint name);
void destroyFramebuffer(GLuint name);
void destroyVertexArray(GLuint name);
void destroyQuery(GLuint name);

/// Memory of the GPU. Its size never changes; it may be empty.
class Buffer : public Handle<destroyBuffer> {
  public:
    /// Contents are set once, here.
    static Buffer immutable(std::span<const std::byte> contents);
    /// Contents may be written again and again.
    static Buffer updatable(std::size_t bytes);

    void write(std::size_t offset, std::span<const std::byte> contents) const;
    /// Waits for what the GPU still writes.
    void read(std::size_t offset, std::span<std::byte> contents) const;
    std::size_t bytes() const { return bytes_; }

  private:
    Buffer(std::size_t bytes, const void* contents, GLbitfield flags);
    std::size_t bytes_;
};

/// A 2D texture without mipmaps, read without filtering. `format` is a sized internal format, e.g.
/// GL_RGBA32F. With more than one layer it is an array texture.
class Texture : public Handle<destroyTexture> {
  public:
    Texture(GLenum format, glm::ivec2 size, int layers = 1);

    glm::ivec2 size() const { return size_; }
    int layers() const { return layers_; }

  private:
    glm::ivec2 size_;
    int layers_;
};

/// A 3D texture without mipmaps, clamped at its sides. `format` is a sized internal format of floats,
/// `filter` GL_NEAREST or GL_LINEAR.
class Texture3D : public Handle<destroyTexture> {
  public:
    Texture3D(GLenum format, glm::ivec3 size, GLint filter);

    /// All texels, x fastest; `channels` is GL_RED, GL_RG, ...
    void write(GLenum channels, std::span<const float> texels) const;
    glm::ivec3 size() const { return size_; }

  private:
    glm::ivec3 size_;
};

/// Textures to draw into: fragment output i goes to colors[i].
class Framebuffer : public Handle<destroyFramebuffer> {
  public:
    /// `depth` may be null. The textures must outlive the framebuffer; without any, `size` is what shaders
    /// with other outputs draw over. Throws Error, naming `label`, where the driver cannot draw into this
    /// combination.
    Framebuffer(std::span<const Texture* const> colors, const Texture* depth, const std::string& label,
                glm::ivec2 size = {1, 1});
};

/// How vertices are fetched. The buffers must outlive it.
class VertexArray : public Handle<destroyVertexArray> {
  public:
    VertexArray();

    /// Attribute `location` reads three floats a vertex, tightly packed.
    void setVec3(GLuint location, const Buffer& buffer) const;
    /// Attribute `location` reads one float a vertex, tightly packed.
    void setFloat(GLuint location, const Buffer& buffer) const;
    /// Indices are 32-bit.
    void setIndices(const Buffer& buffer) const;
};

/// Time that the GPU spends between `begin` and `end`.
class TimerQuery : public Handle<destroyQuery> {
  public:
    TimerQuery();
    void begin() const;
    void end() const;
    /// Waits until the GPU has passed `end`.
    double milliseconds() const;
};

}  // namespace isoglass::gl
