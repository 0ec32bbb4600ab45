#pragma once

#include <QOpenGLExtraFunctions>
#include <QRect>
#include <QSize>
#include <QVector2D>

#include <memory>

class QOpenGLShaderProgram;

namespace handway::gui {

/// Makes a program that computes every pixel of the viewport. Its fragment shader (GLSL 1.20) has
/// the pixel's position, from (0, 0) at the lower left to (1, 1), as `varying vec2 place`.
/// @returns nullptr if the card can't have it. Needs a current context, as all below.
[[nodiscard]] std::unique_ptr<QOpenGLShaderProgram> make_screen_program(const char* fragment);

/// Makes a frame buffer what is drawn into.
void bind_frame(unsigned frame);

/// Restricts drawing to a part of the picture, px from the lower left.
void restrict_to(const QRect& part);

/// Returns the size of a pixel of a texture, in shares of the texture.
[[nodiscard]] QVector2D step_of(const QSize& size);

/// Draws one rectangle over the whole viewport with the bound program.
void fill_viewport();

/// A texture with one value per pixel, which can be drawn into.
class ScreenTexture : protected QOpenGLExtraFunctions {
 public:
  /// Values of a texture.
  enum class Kind {
    kPair,   ///< Two floats.
    kDepth,  ///< Depth (24 bits) with stencil, without a colour.
  };

  explicit ScreenTexture(Kind kind) : kind_(kind) {}
  ~ScreenTexture();
  ScreenTexture(const ScreenTexture&) = delete;
  ScreenTexture& operator=(const ScreenTexture&) = delete;

  /// Makes it what is drawn into, with a viewport of that size, px.
  /// @returns false if the card can't.
  [[nodiscard]] bool bind(const QSize& size);
  /// Makes it the texture of a unit. @pre bind() was called once.
  void use(int unit);

 private:
  [[nodiscard]] bool create(const QSize& size);
  void destroy();

  Kind kind_;
  QSize size_;
  unsigned frame_ = 0;
  unsigned texture_ = 0;
};

}  // namespace handway::gui
