#include "view3d/backdrop.h"

#include <GL/gl.h>

namespace handway::gui {

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
