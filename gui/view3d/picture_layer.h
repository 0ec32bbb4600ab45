#pragma once

#include "handway/geometric/mesh/shape.h"

#include <QOpenGLExtraFunctions>
#include <QRect>
#include <QSize>

#include <memory>

class QOpenGLShaderProgram;

namespace handway::gui {

/// A picture with its depth, kept by the graphics card to be laid into others. All functions but
/// the constructor need the context current in which it is used.
class PictureLayer : protected QOpenGLExtraFunctions {
 public:
  PictureLayer() = default;
  ~PictureLayer();
  PictureLayer(const PictureLayer&) = delete;
  PictureLayer& operator=(const PictureLayer&) = delete;

  /// Makes it what is drawn into, of that size, px. @returns false if the card can't.
  bool bind(const QSize& size);
  void destroy();
  [[nodiscard]] unsigned frame() const { return frame_; }

  /// Copies a part of it, with its depth, to the same place in what is drawn into.
  /// @param target that frame buffer. @param part px from the lower left.
  /// @returns false if the card can't, as their kinds of depth differ.
  [[nodiscard]] bool copy(unsigned target, const QRect& part);
  /// Ways to draw it into another picture.
  enum class Mode {
    kReplace,  ///< Everywhere.
    kBlend,    ///< Only if it is not transparent, and nothing is in front of it.
  };
  /// Draws it over the whole viewport, with its depth, by a program with its colours and depths as
  /// textures `color` and `depth`.
  void draw(QOpenGLShaderProgram& program, Mode mode);

  /// The program that draw() needs; nullptr if the card can't have it.
  [[nodiscard]] static std::unique_ptr<QOpenGLShaderProgram> make_program();

 private:
  bool create(const QSize& size);

  QSize size_;
  unsigned frame_ = 0;
  unsigned color_ = 0;
  unsigned depth_ = 0;
};

/// Fills the current viewport with a vertical gradient. Needs a current OpenGL
/// context of the compatibility profile; leaves its state as it was.
void draw_backdrop(const geometric::Color& top, const geometric::Color& bottom);

}  // namespace handway::gui
