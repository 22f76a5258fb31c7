#pragma once

// OpenGL for this folder's sources only.
#include <GL/gl.h>
#include <GL/glcorearb.h>

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"

namespace glovebench::render::gl {

/// Drawn depth, m.
inline constexpr double kNear = 0.05;
inline constexpr double kFar = 10.0;

/// From camera to clip coordinates, top row first, pixel centers at +0.5. Front faces become clockwise
/// (glFrontFace(GL_CW), set_pass_state).
Eigen::Matrix4f projection(const PinholeCamera& camera);

/// Throws: std::logic_error if the shaders do not compile.
class Program {
 public:
  Program(const std::string& vertex_source, const std::string& fragment_source);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const;
  void set(const char* name, const Eigen::Matrix4f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, float value) const;
  void set(const char* name, int value) const;
  void set(const char* name, std::span<const Eigen::Vector4f> values) const;

 private:
  GLint location(const char* name) const;
  GLuint id_;
};

/// Color attachments and 32-bit float depth.
class Framebuffer {
 public:
  explicit Framebuffer(std::vector<GLenum> formats) : formats_(std::move(formats)) {}
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  /// Makes textures for a new size.
  void bind(int width, int height);
  GLuint texture(int attachment) const { return textures_[attachment]; }
  /// Copies pixels, top row first.
  void read(int attachment, GLenum format, GLenum type, int left, int top, int width, int height,
            void* pixels) const;

 private:
  void release();
  GLuint attach(GLenum point, GLenum format) const;
  std::vector<GLenum> formats_;
  std::vector<GLuint> textures_;
  GLuint depth_ = 0;
  GLuint id_ = 0;
  int width_ = 0;
  int height_ = 0;
};

class VertexArray {
 public:
  VertexArray();
  ~VertexArray();
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;

  void set_floats(int location, std::span<const Eigen::Vector3f> values, GLenum usage);
  void set_bytes(int location, std::span<const uint8_t> values);
  void set_indices(std::span<const uint32_t> indices);
  void draw() const;
  GLuint id() const { return id_; }

 private:
  void bind_buffer(int location);
  GLuint id_ = 0;
  GLuint indices_ = 0;
  GLsizei index_count_ = 0;
  std::vector<GLuint> buffers_;
};

/// Depth test, back-face culling, no blending or dithering.
void set_pass_state();
/// Limits clearing and drawing until `set_pass_state`.
void limit_to(int left, int top, int width, int height);

}  // namespace glovebench::render::gl
