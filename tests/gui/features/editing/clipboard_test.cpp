#include "features/editing/editing_test.h"
#include "features/editing/scene_tree.h"
#include "handway/geometric/formats/scene_file.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QLineEdit>

#include <fstream>

namespace handway::test {
namespace {

class Clipboard : public EditingTest {
 protected:
  static std::string text() { return QGuiApplication::clipboard()->text().toStdString(); }
  static void set_text(const char* text) {
    QGuiApplication::clipboard()->setText(QString::fromUtf8(text));
  }
  void press(const char* keys) const {
    QApplication::setActiveWindow(&window());  // there is no window manager
    const QKeySequence sequence{QLatin1String(keys)};
    QWidget* focus = window().focusWidget();
    QTest::keyClick(focus ? focus : &window(),
                    static_cast<Qt::Key>(sequence[0] & ~Qt::ControlModifier), Qt::ControlModifier);
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const geometric::SceneObject& object : scene().objects) {
      names.push_back(object.name);
    }
    return names;
  }
};

TEST_F(Clipboard, CopiesBesideUnderANewName) {
  for (QWidget* place :
       {static_cast<QWidget*>(&window().view()), static_cast<QWidget*>(&tool<gui::SceneTree>())}) {
    select("post");
    place->setFocus();
    const std::size_t before = scene().objects.size();
    press("Ctrl+C");
    press("Ctrl+V");
    ASSERT_EQ(scene().objects.size(), before + 1);
    const geometric::SceneObject& copy = scene().objects.back();
    EXPECT_EQ(editor().selection().name, copy.name);
    EXPECT_GT((copy.X_PO.translation() - object("post").X_PO.translation()).norm(), 0.04);
    EXPECT_EQ(editor().undo_stack().undoText().toStdString(), "Paste " + copy.name);
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"post", "post 2", "post 3"}));
}

TEST_F(Clipboard, HoldsTheObjectsAsASceneFileDoes) {
  select("post");
  editor().set_color({0.25F, 0.5F, 0.75F, 1.0F});
  press("Ctrl+C");
  EXPECT_EQ(text(),
            "objects:\n  - name: post\n    box: {size: [0.04, 0.04, 0.4]}\n"
            "    pose: {xyz: [0.41, 0.38, 0], rpy_deg: [0, 0, 0]}\n    color: [0.25, 0.5, 0.75]\n");
}

TEST_F(Clipboard, BringsObjectsIntoAnotherSceneWhereTheyWere) {
  editor().add("can", geometric::Cylinder{0.03, 0.12}, {}, {-0.5, -0.5, 0.0});
  editor().add("lid", geometric::Cylinder{0.03, 0.01}, {}, {-0.5, -0.5, 0.1205});
  editor().select_objects({"can", "lid"});
  part<QAction>("group").trigger();
  const geometric::Pose X_WO = object("lid").X_PO;
  press("Ctrl+C");
  editor().undo_stack().setClean();  // avoids the question about unsaved changes
  open(cell().wall());
  press("Ctrl+V");
  EXPECT_EQ(names(), (std::vector<std::string>{"wall", "can", "lid"}));
  EXPECT_TRUE(object("lid").X_PO.isApprox(X_WO, 1e-12));
  EXPECT_EQ(display("can").group, "group");
  press("Ctrl+V");
  EXPECT_EQ(display("lid 2").group, "group 2");
  EXPECT_EQ(display("can 2").group, "group 2");
}

TEST_F(Clipboard, LeavesWhatIsCarriedInTheWorld) {
  select("post");
  editor().attach("arm", "palm", {});
  const geometric::Pose X_WO = *editor().selected_pose();
  press("Ctrl+X");
  EXPECT_TRUE(scene().objects.empty());
  press("Ctrl+V");
  EXPECT_FALSE(object("post").attachment);
  EXPECT_TRUE(object("post").X_PO.isApprox(X_WO, 1e-9));
}

TEST_F(Clipboard, KeepsMeshesThatNoFileHolds) {
  geometric::Mesh made;
  made.triangles = geometric::tessellate(geometric::Box{{0.1, 0.2, 0.3}});
  editor().add("made", made, {}, {-0.5, -0.5, 0.0});
  press("Ctrl+C");
  press("Ctrl+V");
  const auto& copy = std::get<geometric::Mesh>(object("made 2").shape);
  EXPECT_TRUE(copy.file.empty()) << "the next copy would write there";
  EXPECT_EQ(copy.triangles->triangles.size(), made.triangles->triangles.size());
}

TEST_F(Clipboard, TakesAPieceOfASceneFileThatAPersonCopied) {
  set_text("- name: ball\n  sphere: {radius: 0.05}\n  attach: {link: palm}\n");
  press("Ctrl+V");
  EXPECT_EQ(object("ball").attachment->link, "palm");
}

TEST_F(Clipboard, OffersToPasteObjectsOnly) {
  const QAction& paste = *actions().paste;
  for (const char* text : {"", "a shopping list", "name: ball"}) {
    set_text(text);
    EXPECT_FALSE(paste.isEnabled()) << text;
    EXPECT_THAT(paste.toolTip().toStdString(), ::testing::HasSubstr("holds no objects"));
  }
  for (const char* text : {"- {name: ball, sphere: {radius: 0.05}}", "handway: 1\nobjects: []\n"}) {
    set_text(text);
    EXPECT_TRUE(paste.isEnabled()) << text;
  }
}

TEST_F(Clipboard, SaysWhatIsWrongWithObjects) {
  set_text("objects:\n  - name: ball\n    sphere: {radius: -1}\n");
  press("Ctrl+V");
  EXPECT_THAT(window().message().toStdString(), ::testing::HasSubstr("the clipboard:3"));
  EXPECT_EQ(names(), std::vector<std::string>{"post"});
}

TEST_F(Clipboard, AnObjectIsNeverCalledLikeALink) {
  select("post");
  auto& name = part<QLineEdit>("object_name");
  name.selectAll();
  QTest::keyClicks(&name, QStringLiteral("palm"));
  QTest::keyClick(&name, Qt::Key_Return);
  EXPECT_EQ(names(), std::vector<std::string>{"post"});
  EXPECT_THAT(window().message().toStdString(),
              ::testing::HasSubstr("palm is the name of a link of arm. Choose another one."));
  EXPECT_EQ(name.text(), QStringLiteral("post"));
  editor().add("palm", geometric::Sphere{0.05}, {}, {-0.5, 0.0, 0.0});
  EXPECT_EQ(names().back(), "palm 2");
}

}  // namespace
}  // namespace handway::test
