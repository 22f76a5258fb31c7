#include "render/gl.h"

#include "core/base/error.h"

namespace glovebench::render::gl {
namespace {

GLuint compile(GLenum kind, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint fine = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
  std::array<char, 1024> log{};
  if (!fine) glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
  check(fine, (std::string("a shader compiles: ") + log.data()).c_str());
  return shader;
}

}  // namespace

Eigen::Matrix4f projection(const PinholeCamera& camera) {
  const double w = camera.width;
  const double h = camera.height;
  Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
  P(0, 0) = 2 * camera.fx / w;
  P(0, 2) = 2 * (camera.cx + 0.5) / w - 1;
  P(1, 1) = 2 * camera.fy / h;
  P(1, 2) = 2 * (camera.cy + 0.5) / h - 1;
  P(2, 2) = (kFar + kNear) / (kFar - kNear);
  P(2, 3) = -2 * kFar * kNear / (kFar - kNear);
  P(3, 2) = 1;
  return P.cast<float>();
}

Program::Program(const std::string& vertex_source, const std::string& fragment_source) : id_(glCreateProgram()) {
  const GLuint vertex = compile(GL_VERTEX_SHADER, vertex_source);
  const GLuint fragment = compile(GL_FRAGMENT_SHADER, fragment_source);
  glAttachShader(id_, vertex);
  glAttachShader(id_, fragment);
  glLinkProgram(id_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint fine = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &fine);
  check(fine, "a shader program links");
}

Program::~Program() { glDeleteProgram(id_); }

void Program::use() const { glUseProgram(id_); }

GLint Program::location(const char* name) const { return glGetUniformLocation(id_, name); }

void Program::set(const char* name, const Eigen::Matrix4f& value) const {
  glUniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

void Program::set(const char* name, const Eigen::Vector3f& value) const {
  glUniform3fv(location(name), 1, value.data());
}

void Program::set(const char* name, float value) const { glUniform1f(location(name), value); }

void Program::set(const char* name, int value) const { glUniform1i(location(name), value); }

void Program::set(const char* name, std::span<const Eigen::Vector4f> values) const {
  glUniform4fv(location(name), static_cast<GLsizei>(values.size()), values.front().data());
}

Framebuffer::~Framebuffer() { release(); }

void Framebuffer::release() {
  if (id_ == 0) return;
  glDeleteFramebuffers(1, &id_);
  glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
  glDeleteTextures(1, &depth_);
  textures_.clear();
  id_ = 0;
}

GLuint Framebuffer::attach(GLenum point, GLenum format) const {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width_, height_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture, 0);
  return texture;
}

void Framebuffer::bind(int width, int height) {
  if (id_ == 0 || width != width_ || height != height_) {
    release();
    width_ = width;
    height_ = height;
    glGenFramebuffers(1, &id_);
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    std::vector<GLenum> points;
    for (GLenum format : formats_) {
      points.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(points.size()));
      textures_.push_back(attach(points.back(), format));
    }
    depth_ = attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F);
    glDrawBuffers(static_cast<GLsizei>(points.size()), points.data());
    check(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "a framebuffer is complete");
  }
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  glViewport(0, 0, width, height);
}

void Framebuffer::read(int attachment, GLenum format, GLenum type, int left, int top, int width, int height,
                       void* pixels) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
  glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(left, top, width, height, format, type, pixels);
}

VertexArray::VertexArray() { glGenVertexArrays(1, &id_); }

VertexArray::~VertexArray() {
  glDeleteVertexArrays(1, &id_);
  glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  glDeleteBuffers(1, &indices_);
}

void VertexArray::bind_buffer(int location) {
  glBindVertexArray(id_);
  if (buffers_.size() <= static_cast<size_t>(location)) buffers_.resize(location + 1, 0);
  if (buffers_[location] == 0) glGenBuffers(1, &buffers_[location]);
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[location]);
  glEnableVertexAttribArray(location);
}

void VertexArray::set_floats(int location, std::span<const Eigen::Vector3f> values, GLenum usage) {
  bind_buffer(location);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), usage);
  glVertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
}

void VertexArray::set_bytes(int location, std::span<const uint8_t> values) {
  bind_buffer(location);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), GL_STATIC_DRAW);
  glVertexAttribIPointer(location, 1, GL_UNSIGNED_BYTE, 0, nullptr);
}

void VertexArray::set_indices(std::span<const uint32_t> indices) {
  glBindVertexArray(id_);
  if (indices_ == 0) glGenBuffers(1, &indices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size_bytes()), indices.data(),
               GL_STATIC_DRAW);
  index_count_ = static_cast<GLsizei>(indices.size());
}

void VertexArray::draw() const {
  glBindVertexArray(id_);
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

void set_pass_state() {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CW);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_DITHER);
}

void limit_to(int left, int top, int width, int height) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(left, top, width, height);
}

}  // namespace glovebench::render::gl
