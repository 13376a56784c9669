#include "gl/objects.h"

#include "base/error.h"

#include <cstdio>
#include <vector>

namespace isoglass::gl {
namespace {

template <typename Create>
GLuint make(const Create& create) {
    GLuint name = 0;
    create(&name);
    return name;
}

}  // namespace

void destroyBuffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
void destroyTexture(GLuint name) {
    glDeleteTextures(1, &name);
}
void destroyFramebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}
void destroyVertexArray(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
void destroyQuery(GLuint name) {
    glDeleteQueries(1, &name);
}

Buffer::Buffer(std::size_t bytes, const void* contents, GLbitfield flags)
    : Handle(make([](GLuint* name) { glCreateBuffers(1, name); })), bytes_(bytes) {
    // Storage of no bytes is an error in GL.
    if (bytes > 0) glNamedBufferStorage(name(), static_cast<GLsizeiptr>(bytes), contents, flags);
}

Buffer Buffer::immutable(std::span<const std::byte> contents) {
    return {contents.size(), contents.data(), 0};
}

Buffer Buffer::updatable(std::size_t bytes) {
    return {bytes, nullptr, GL_DYNAMIC_STORAGE_BIT};
}

void Buffer::write(std::size_t offset, std::span<const std::byte> contents) const {
    glNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(contents.size()),
                         contents.data());
}

void Buffer::read(std::size_t offset, std::span<std::byte> contents) const {
    glGetNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(contents.size()),
                            contents.data());
}

Texture::Texture(GLenum format, glm::ivec2 size, int layers)
    : Handle(make([layers](GLuint* name) {
          glCreateTextures(layers > 1 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, name);
      })),
      size_(size),
      layers_(layers) {
    if (layers > 1) {
        glTextureStorage3D(name(), 1, format, size.x, size.y, layers);
    } else {
        glTextureStorage2D(name(), 1, format, size.x, size.y);
    }
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Texture3D::Texture3D(GLenum format, glm::ivec3 size, GLint filter)
    : Handle(make([](GLuint* name) { glCreateTextures(GL_TEXTURE_3D, 1, name); })), size_(size) {
    glTextureStorage3D(name(), 1, format, size.x, size.y, size.z);
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(name(), GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(name(), axis, GL_CLAMP_TO_EDGE);
}

void Texture3D::write(GLenum channels, std::span<const float> texels) const {
    glTextureSubImage3D(name(), 0, 0, 0, 0, size_.x, size_.y, size_.z, channels, GL_FLOAT, texels.data());
}

Framebuffer::Framebuffer(std::span<const Texture* const> colors, const Texture* depth,
                         const std::string& label, glm::ivec2 size)
    : Handle(make([](GLuint* name) { glCreateFramebuffers(1, name); })) {
    std::vector<GLenum> outputs;
    for (const Texture* color : colors) {
        outputs.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(outputs.size()));
        glNamedFramebufferTexture(name(), outputs.back(), color->name(), 0);
    }
    glNamedFramebufferDrawBuffers(name(), static_cast<GLsizei>(outputs.size()), outputs.data());
    glNamedFramebufferParameteri(name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, size.x);
    glNamedFramebufferParameteri(name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, size.y);
    if (depth != nullptr) glNamedFramebufferTexture(name(), GL_DEPTH_ATTACHMENT, depth->name(), 0);
    const GLenum status = glCheckNamedFramebufferStatus(name(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        char text[16];
        std::snprintf(text, sizeof text, "0x%04X", status);
        throw Error(std::string("the driver cannot draw into this framebuffer: status ") + text, label);
    }
}

VertexArray::VertexArray() : Handle(make([](GLuint* name) { glCreateVertexArrays(1, name); })) {}

void VertexArray::setVec3(GLuint location, const Buffer& buffer) const {
    glVertexArrayVertexBuffer(name(), location, buffer.name(), 0, 3 * sizeof(float));
    glVertexArrayAttribFormat(name(), location, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(name(), location, location);
    glEnableVertexArrayAttrib(name(), location);
}

void VertexArray::setFloat(GLuint location, const Buffer& buffer) const {
    glVertexArrayVertexBuffer(name(), location, buffer.name(), 0, sizeof(float));
    glVertexArrayAttribFormat(name(), location, 1, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(name(), location, location);
    glEnableVertexArrayAttrib(name(), location);
}

void VertexArray::setIndices(const Buffer& buffer) const {
    glVertexArrayElementBuffer(name(), buffer.name());
}

TimerQuery::TimerQuery() : Handle(make([](GLuint* name) { glCreateQueries(GL_TIME_ELAPSED, 1, name); })) {}

void TimerQuery::begin() const {
    glBeginQuery(GL_TIME_ELAPSED, name());
}

void TimerQuery::end() const {
    glEndQuery(GL_TIME_ELAPSED);
}

double TimerQuery::milliseconds() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(name(), GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-6;
}

}  // namespace isoglass::gl
