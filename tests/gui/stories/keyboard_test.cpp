/// Tests the way from the start page to a saved scene with a plan, with the keyboard alone.
#include "features/editing/scene_tree.h"
#include "hands_on.h"
#include "handway/geometric/formats/scene_file.h"

#include <QCheckBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>
#include <QUndoStack>

namespace handway::test {
namespace {

class Keyboard : public HandsOn {
 protected:
  /// A key, for whatever has the focus.
  void hit(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) const {
    QWidget* popup = QApplication::activePopupWidget();
    if (!popup && !QApplication::activeModalWidget()) {
      activate();  // a menu that has closed doesn't, where there is no window manager
    }
    QWidget* at = popup ? popup : QApplication::focusWidget();
    QTest::keyClick(at ? at : &window(), static_cast<Qt::Key>(key), modifiers);
  }
  /// Tab until it has the focus; a tour of the window that ends without it fails.
  void tab_to(const QWidget& widget) const {
    const QWidget* first = nullptr;
    constexpr int kMoreThanThereAre = 400;
    for (int tabs = 0; tabs < kMoreThanThereAre && QApplication::focusWidget() != &widget; ++tabs) {
      hit(Qt::Key_Tab);
      const QWidget* now = QApplication::focusWidget();
      ASSERT_TRUE(now) << "nothing has the focus";
      ASSERT_TRUE(!first || now != first) << "not on the tour: " << name_of(widget);
      first = first ? first : now;
    }
    ASSERT_EQ(QApplication::focusWidget(), &widget) << name_of(widget);
    EXPECT_TRUE(widget.isVisible() && !widget.visibleRegion().isEmpty()) << name_of(widget);
  }
  static std::string name_of(const QWidget& widget) {
    return (widget.objectName() + ' ' + widget.metaObject()->className()).toStdString();
  }
  void tab_to(const char* name) const { tab_to(part<QWidget>(name)); }
  void enter(const char* field, const char* text) const {
    ASSERT_NO_FATAL_FAILURE(tab_to(field));
    enter(text);
  }
  /// Types over the content of the field that has the focus.
  void enter(const char* text) const {
    hit(Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(QApplication::focusWidget(), QString::fromUtf8(text));
    hit(Qt::Key_Return);
    QCoreApplication::processEvents();
  }
  /// The underlined letters of a menu and of an entry.
  void menu(char top, char letter) const {
    hit(top, Qt::AltModifier);
    ASSERT_TRUE(wait_for([] { return QApplication::activePopupWidget() != nullptr; })) << top;
    hit(letter);
    EXPECT_FALSE(QApplication::activePopupWidget()) << "more than one entry has " << letter;
  }
  void show_page(const QString& title) const {
    auto* bar = part<QTabWidget>("control_tabs").tabBar();
    ASSERT_NO_FATAL_FAILURE(tab_to(*bar));
    for (const Qt::Key key : {Qt::Key_Left, Qt::Key_Right}) {
      for (int i = 0; i < bar->count() && bar->tabText(bar->currentIndex()) != title; ++i) {
        hit(key);
      }
    }
    ASSERT_EQ(bar->tabText(bar->currentIndex()), title);
  }

  void open_a_scene() const;
  void add_a_box() const;
  void set_a_goal() const;
  void choose_what_moves() const;
  void plan_and_play() const;
  void save_as(const std::filesystem::path& file) const;
};

void Keyboard::open_a_scene() const {
  QSignalSpy ready(&window(), &gui::MainWindow::ready);
  const QWidget& page = part<QWidget>("start_page");
  EXPECT_EQ(QApplication::focusWidget(), &page);
  hit(Qt::Key_Tab);
  EXPECT_TRUE(page.isAncestorOf(QApplication::focusWidget()));
  ASSERT_NO_FATAL_FAILURE(tab_to("open can_on_table"));
  hit(Qt::Key_Return);
  ASSERT_TRUE(wait_for([&] { return !ready.isEmpty(); }));
  EXPECT_EQ(scene().name, "Can on a table");
}

void Keyboard::add_a_box() const {
  ASSERT_NO_FATAL_FAILURE(menu('A', 'B'));
  ASSERT_EQ(editor().selection().name, "box");
  ASSERT_NO_FATAL_FAILURE(enter("position_x", "760 mm"));
  EXPECT_EQ(window().focusWidget(), &window().view());
  ASSERT_NO_FATAL_FAILURE(enter("position_y", "600 mm"));
  ASSERT_NO_FATAL_FAILURE(enter("object_name", "parcel"));
  hit(Qt::Key_End);
  EXPECT_TRUE(object("parcel").X_PO.translation().head<2>().isApprox(Eigen::Vector2d(0.76, 0.6)));
  auto& tree = *window().findChild<gui::SceneTree*>();
  ASSERT_NO_FATAL_FAILURE(tab_to(tree));
  hit(Qt::Key_Up);
  EXPECT_EQ(editor().selection().name, "can");
  hit(Qt::Key_Down);
  EXPECT_EQ(editor().selection().name, "parcel");
}

void Keyboard::set_a_goal() const {
  ASSERT_NO_FATAL_FAILURE(show_page(QStringLiteral("Joints")));
  ASSERT_NO_FATAL_FAILURE(tab_to("go_to_goal"));
  hit(Qt::Key_Space);
  ASSERT_TRUE(window().document().configuration().isApprox(*scene().goal));
  const geometric::Configuration before = *scene().goal;
  auto* joint = part<QWidget>("joint_2").findChild<QAbstractSpinBox*>();
  ASSERT_NO_FATAL_FAILURE(tab_to(*joint));
  enter("18");
  ASSERT_NO_FATAL_FAILURE(menu('P', 'G'));
  EXPECT_NEAR((*scene().goal)[1], geometric::radians(18.0), 1e-6);
  EXPECT_NE(*scene().goal, before);
}

void Keyboard::choose_what_moves() const {
  ASSERT_NO_FATAL_FAILURE(show_page(QStringLiteral("Plan")));
  ASSERT_NO_FATAL_FAILURE(tab_to("moving_group"));
  QTimer watch;  // the open menu has an event loop of its own
  QObject::connect(&watch, &QTimer::timeout, &watch, [&] {
    if (QApplication::activePopupWidget()) {
      watch.stop();
      hit(Qt::Key_Down);
      hit(Qt::Key_Down);
      hit(Qt::Key_Return);
    }
  });
  watch.start(20);
  hit(Qt::Key_Return);
  ASSERT_TRUE(wait_for([&] { return !watch.isActive() && !QApplication::activePopupWidget(); }));
  EXPECT_EQ(scene().group.size(), 1U);
  hit(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(scene().group.empty());
}

void Keyboard::plan_and_play() const {
  QSignalSpy ended(&window().session(), &gui::PlanningSession::ended);
  hit(Qt::Key_P, Qt::ControlModifier);
  ASSERT_TRUE(wait_for([&] { return !ended.isEmpty(); }));
  ASSERT_TRUE(ended.front().front().toBool());
  ASSERT_NO_FATAL_FAILURE(tab_to("play"));
  hit(Qt::Key_Space);
  ASSERT_TRUE(wait_for([&] { return window().player().fraction() > 0.3; }));
  hit(Qt::Key_Space);
  EXPECT_FALSE(window().player().is_playing());
}

void Keyboard::save_as(const std::filesystem::path& file) const {
  QTimer watch;  // the dialog has an event loop of its own
  QObject::connect(&watch, &QTimer::timeout, &watch, [&] {
    if (auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) {
      watch.stop();
      QApplication::setActiveWindow(dialog);
      EXPECT_TRUE(qobject_cast<QLineEdit*>(QApplication::focusWidget())) << "the name comes first";
      enter(file.c_str());
    }
  });
  watch.start(20);
  hit(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_TRUE(wait_for([&] { return std::filesystem::exists(file); }));
}

TEST_F(Keyboard, OpensEditsPlansPlaysAndSaves) {
  ASSERT_NO_FATAL_FAILURE(open_a_scene());
  ASSERT_NO_FATAL_FAILURE(add_a_box());
  ASSERT_NO_FATAL_FAILURE(set_a_goal());
  ASSERT_NO_FATAL_FAILURE(choose_what_moves());
  ASSERT_NO_FATAL_FAILURE(plan_and_play());
  picture("keyboard_alone");
  const std::filesystem::path file = folder_.path() / "keys.yaml";
  ASSERT_NO_FATAL_FAILURE(save_as(file));
  EXPECT_TRUE(geometric::find_object(geometric::read_scene(file), "parcel"));
}

}  // namespace
}  // namespace handway::test
