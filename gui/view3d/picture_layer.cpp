#include "view3d/picture_layer.h"

#include "view3d/screen_pass.h"

#include <QOpenGLContext>
#include <QOpenGLShaderProgram>

#include <GL/gl.h>

namespace handway::gui {
namespace {

const char* const kFragmentShader = R"(#version 120
uniform sampler2D color;
uniform sampler2D depth;
varying vec2 place;
void main() {
  gl_FragColor = texture2D(color, place);
  gl_FragDepth = texture2D(depth, place).r;
}
)";

unsigned make_texture(const QSize& size, int kind, unsigned format, unsigned type) {
  unsigned texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexImage2D(GL_TEXTURE_2D, 0, kind, size.width(), size.height(), 0, format, type, nullptr);
  glBindTexture(GL_TEXTURE_2D, 0);
  return texture;
}

}  // namespace

PictureLayer::~PictureLayer() {
  if (QOpenGLContext::currentContext()) {
    destroy();
  }
}

void PictureLayer::destroy() {
  if (frame_ != 0) {
    glDeleteFramebuffers(1, &frame_);
    glDeleteTextures(1, &color_);
    glDeleteTextures(1, &depth_);
    frame_ = color_ = depth_ = 0;
  }
}

bool PictureLayer::create(const QSize& size) {
  initializeOpenGLFunctions();
  destroy();
  size_ = size;
  color_ = make_texture(size, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
  depth_ = make_texture(size, GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8);
  glGenFramebuffers(1, &frame_);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_, 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

bool PictureLayer::bind(const QSize& size) {
  if (frame_ == 0 || size != size_) {
    return create(size);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  return true;
}

bool PictureLayer::copy(unsigned target, const QRect& part) {
  const int left = part.left(), lower = part.top();
  const int right = left + part.width(), upper = lower + part.height();
  while (glGetError() != GL_NO_ERROR) {
  }
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
  glBlitFramebuffer(left, lower, right, upper, left, lower, right, upper,
                    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  return glGetError() == GL_NO_ERROR;
}

void PictureLayer::draw(QOpenGLShaderProgram& program, Mode mode) {
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(mode == Mode::kBlend ? GL_LESS : GL_ALWAYS);
  glDisable(GL_LIGHTING);
  glDisable(GL_CULL_FACE);
  if (mode == Mode::kBlend) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  } else {
    glDisable(GL_BLEND);
  }
  program.bind();
  program.setUniformValue("color", 0);
  program.setUniformValue("depth", 1);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, depth_);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, color_);
  fill_viewport();
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, 0);
  program.release();
  glPopAttrib();
}

std::unique_ptr<QOpenGLShaderProgram> PictureLayer::make_program() {
  return make_screen_program(kFragmentShader);
}

void draw_backdrop(const geometric::Color& top, const geometric::Color& bottom) {
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_LIGHTING);
  glDisable(GL_CULL_FACE);
  glDisable(GL_TEXTURE_2D);
  glDisable(GL_BLEND);
  glDepthMask(GL_FALSE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glMatrixMode(GL_PROJECTION);
  glPushMatrix();
  glLoadIdentity();
  glMatrixMode(GL_MODELVIEW);
  glPushMatrix();
  glLoadIdentity();
  glBegin(GL_QUADS);
  glColor3f(bottom.red, bottom.green, bottom.blue);
  glVertex2f(-1.0F, -1.0F);
  glVertex2f(1.0F, -1.0F);
  glColor3f(top.red, top.green, top.blue);
  glVertex2f(1.0F, 1.0F);
  glVertex2f(-1.0F, 1.0F);
  glEnd();
  glPopMatrix();
  glMatrixMode(GL_PROJECTION);
  glPopMatrix();
  glMatrixMode(GL_MODELVIEW);
  glPopAttrib();
}

}  // namespace handway::gui
