#include "view3d/screen_pass.h"

#include <QOpenGLContext>
#include <QOpenGLShaderProgram>

#include <GL/gl.h>

namespace handway::gui {
namespace {

const char* const kVertexShader = R"(#version 120
varying vec2 place;
void main() {
  place = 0.5 * gl_Vertex.xy + 0.5;
  gl_Position = gl_Vertex;
}
)";

}  // namespace

std::unique_ptr<QOpenGLShaderProgram> make_screen_program(const char* fragment) {
  auto program = std::make_unique<QOpenGLShaderProgram>();
  const bool linked = program->addShaderFromSourceCode(QOpenGLShader::Vertex, kVertexShader) &&
                      program->addShaderFromSourceCode(QOpenGLShader::Fragment, fragment) &&
                      program->link();
  return linked ? std::move(program) : nullptr;
}

void bind_frame(unsigned frame) {
  QOpenGLContext::currentContext()->functions()->glBindFramebuffer(GL_FRAMEBUFFER, frame);
}

void restrict_to(const QRect& part) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(part.x(), part.y(), part.width(), part.height());
}

QVector2D step_of(const QSize& size) {
  return {1.0F / static_cast<float>(size.width()), 1.0F / static_cast<float>(size.height())};
}

void fill_viewport() {
  glBegin(GL_QUADS);
  glVertex2f(-1.0F, -1.0F);
  glVertex2f(1.0F, -1.0F);
  glVertex2f(1.0F, 1.0F);
  glVertex2f(-1.0F, 1.0F);
  glEnd();
}

ScreenTexture::~ScreenTexture() {
  if (QOpenGLContext::currentContext()) {
    destroy();
  }
}

void ScreenTexture::destroy() {
  if (frame_ != 0) {
    glDeleteFramebuffers(1, &frame_);
    glDeleteTextures(1, &texture_);
    frame_ = texture_ = 0;
  }
}

bool ScreenTexture::create(const QSize& size) {
  initializeOpenGLFunctions();
  destroy();
  size_ = size;
  const bool has_depth = kind_ == Kind::kDepth;
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  for (const unsigned filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  }
  for (const unsigned wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  }
  if (has_depth) {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH24_STENCIL8, size.width(), size.height(), 0,
                 GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, nullptr);
  } else {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, size.width(), size.height(), 0, GL_RG, GL_FLOAT,
                 nullptr);
  }
  glBindTexture(GL_TEXTURE_2D, 0);
  glGenFramebuffers(1, &frame_);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glFramebufferTexture2D(GL_FRAMEBUFFER,
                         has_depth ? GL_DEPTH_STENCIL_ATTACHMENT : GL_COLOR_ATTACHMENT0,
                         GL_TEXTURE_2D, texture_, 0);
  if (has_depth) {
    const unsigned none = GL_NONE;
    glDrawBuffers(1, &none);
    glReadBuffer(GL_NONE);
  }
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

bool ScreenTexture::bind(const QSize& size) {
  bool is_made = frame_ != 0 && size == size_;
  if (is_made) {
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  } else {
    is_made = create(size);
  }
  glViewport(0, 0, size.width(), size.height());
  return is_made;
}

void ScreenTexture::use(int unit) {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, texture_);
}

}  // namespace handway::gui
