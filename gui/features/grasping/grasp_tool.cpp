#include "features/grasping/grasp_tool.h"

#include "features/workbench.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/queries/palm_ik.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "model/planning/planning_session.h"
#include "view3d/grasp_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/film_bar.h"
#include "widgets/style/actions.h"
#include "widgets/style/theme.h"

#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>
#include <QVariant>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kWidth = 400;
constexpr int kMargin = 12;
constexpr int kColumnWidth = 60;
constexpr int kFewestRows = 3;
constexpr int kProgressSteps = 1000;
constexpr int kHeldColumn = 5;

QStringList row_texts(int rank, const planning::Pregrasp& grasp) {
  return {QString::number(rank),
          QString::number(grasp.contacts.size()),
          QString::number(grasp.quality.epsilon, 'f', 3),
          QObject::tr("%1 mm").arg(geometric::millimetres(grasp.clearance), 0, 'f', 0),
          QString::number(grasp.score, 'f', 2),
          QString()};
}

QString hold_text(const planning::HoldResult& result) {
  return QObject::tr("%1 of 6").arg(result.directions_held());
}

QString hold_tip(const planning::HoldResult& result) {
  const planning::HoldConditions conditions;
  const QString forces = QObject::tr("Simulated: held against %1 of 6 forces of %2 N")
                             .arg(result.directions_held())
                             .arg(conditions.force);
  if (!result.lift) {
    return forces;
  }
  const QString lift = result.lift->held
                           ? QObject::tr("Raised by 10 cm and held for 5 s: slips by %1 mm and %2°")
                                 .arg(geometric::millimetres(result.lift->shift), 0, 'f', 1)
                                 .arg(geometric::degrees(result.lift->turn), 0, 'f', 1)
                           : QObject::tr("Dropped when it was raised");
  return forces + QLatin1Char('\n') + lift + QLatin1Char('\n') +
         QObject::tr("%1 kg, friction %2").arg(conditions.mass).arg(conditions.contact.friction);
}

// What is done to the object in a part of a hold test.
QString load_text(int load) {
  const QStringList axes{QStringLiteral("+x"), QStringLiteral("-x"), QStringLiteral("+y"),
                         QStringLiteral("-y"), QStringLiteral("+z"), QStringLiteral("-z")};
  if (load == 0) {
    return QObject::tr("Simulation: the hand squeezes.");
  }
  if (load <= axes.size()) {
    return QObject::tr("Simulation: %1 N along %2.")
        .arg(planning::HoldConditions{}.force)
        .arg(axes[load - 1]);
  }
  return QObject::tr("Simulation: raised by 10 cm, seen from the palm.");
}

QString row_tip(const planning::Pregrasp& grasp) {
  QString tip = QObject::tr(
                    "%1 fingers near the object, thumb and fingers %2 % on opposite sides\n"
                    "%3 from the hand's principal motion directions, arm travel %4 (normalised "
                    "joints)")
                    .arg(grasp.fingers)
                    .arg(100.0 * grasp.enclosure, 0, 'f', 0)
                    .arg(grasp.subspace_distance, 0, 'f', 2)
                    .arg(grasp.arm_travel, 0, 'f', 2);
  if (!grasp.doubt.empty()) {
    tip += QLatin1Char('\n') + QString::fromStdString(grasp.doubt);
  }
  return tip;
}

}  // namespace

GraspCard::GraspCard(QWidget* host, std::function<std::vector<QPoint>()> to_be_seen)
    : FloatingCard(host, "grasps", "offer"),
      to_be_seen_(std::move(to_be_seen)),
      title_(heading()),
      details_(new QWidget),
      fold_(make_fold(QStringLiteral("grasp_fold"), *details_)),
      note_(named("grasp_note", note())),
      list_(named("grasp_list", new QTreeWidget)),
      search_(new QWidget),
      progress_(named("grasp_progress", new QProgressBar)),
      film_(named("grasp_film", new QPushButton(tr("Watch the test")))),
      film_bar_(named("grasp_film_bar", new FilmBar)),
      plan_(named("grasp_plan", new QPushButton(tr("Plan to this grasp")))) {
  note_->setWordWrap(true);
  list_->setAccessibleName(tr("Grasps"));
  list_->setFrameShape(QFrame::NoFrame);
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setHeaderLabels(
      {QString(), tr("Contacts"), tr("Epsilon"), tr("Clear"), tr("Score"), tr("Held")});
  list_->header()->setStretchLastSection(false);
  list_->header()->setMinimumSectionSize(scaled(kColumnWidth));
  list_->header()->setSectionResizeMode(QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(0, QHeaderView::Fixed);
  list_->header()->resizeSection(0, scaled(kColumnWidth));
  const QStringList words{tr("Rank"),
                          tr("Contacts of the closed hand with the object"),
                          tr("Smallest disturbance in N that 1 N of contact forces cannot resist, "
                             "with friction %1; 0 or less: it may slip")
                              .arg(planning::PregraspOptions{}.contact.friction),
                          tr("Clearance of robot and hand from all other bodies, up to 50 mm"),
                          tr("Score for the ranking, from 0 to 1"),
                          tr("Simulated: in how many of six directions the object stays in the "
                             "hand")};
  for (int column = 0; column < words.size(); ++column) {
    list_->headerItem()->setToolTip(column, words[column]);
  }
  progress_->setRange(0, kProgressSteps);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  auto* stop = named("grasp_stop", new QPushButton(tr("Stop")));
  stop->setToolTip(tr("End the search and keep what was found"));
  connect(stop, &QPushButton::clicked, this, &GraspCard::stop_requested);
  lay_out(*search_, in_row({{progress_, 1}, stop}, 8));
  film_->setCheckable(true);
  film_->setToolTip(
      tr("Show the simulation of this grasp: the hand squeezes, six forces pull, it is raised"));
  connect(film_, &QPushButton::clicked, this,
          [this](bool wanted) { emit film_wanted(row(), wanted); });
  plan_->setProperty("role", "primary");
  plan_->setToolTip(tr("Set this grasp as the goal, and plan"));
  QToolButton* close = make_close("grasp_close", tr("Leave the goal as it is"));
  connect(close, &QToolButton::clicked, this, [this] {
    hide();
    emit closed();
  });
  connect(list_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    const int row = list_->indexOfTopLevelItem(item);
    plan_->setEnabled(row >= 0);
    update_film();
    if (row >= 0) {
      emit looked_at(row);
    }
  });
  for (const auto by_person : {&QTreeWidget::itemClicked, &QTreeWidget::itemActivated}) {
    connect(list_, by_person, this, [this] { is_chosen_ = true; });
  }
  connect(list_, &QTreeWidget::itemDoubleClicked, plan_, &QPushButton::click);
  connect(plan_, &QPushButton::clicked, this, [this] {
    hide();
    emit chosen(row());
  });
  lay_out(*details_, in_column({note_, search_, {list_, 1}, film_bar_, film_}, 6));
  lay_out(*this,
          in_column({in_row({{title_, 1}, {fold_, 0, Qt::AlignTop}, {close, 0, Qt::AlignTop}}),
                     {details_, 1},
                     plan_},
                    6),
          {12, 6, 8, 10});
}

void GraspCard::show_search(const QString& object) {
  title_->setText(tr("Grasp %1").arg(object));
  listed_.clear();
  list_->clear();
  is_chosen_ = false;
  progress_->setValue(0);
  set_up(tr("Searching for grasps…"), false, true);
}

void GraspCard::show_progress(const std::vector<planning::Pregrasp>& grasps, double fraction) {
  progress_->setValue(static_cast<int>(std::lround(kProgressSteps * fraction)));
  list(grasps);
  const int percent = static_cast<int>(std::lround(100.0 * fraction));
  set_up(
      grasps.empty()
          ? tr("Searching for grasps… %1 %").arg(percent)
          : tr("The best so far, %1 % searched. Choose one, or continue the search.").arg(percent),
      !grasps.empty(), true);
}

void GraspCard::show_grasps(const std::vector<planning::Pregrasp>& grasps, bool stopped) {
  list(grasps);
  set_up(stopped ? tr("The best grasps that were found until the search was stopped.")
                 : tr("The best grasp is first; the ghost shows the selected grasp."),
         true, false);
}

void GraspCard::list(const std::vector<planning::Pregrasp>& grasps) {
  const auto same = [](const planning::Pregrasp& a, const planning::Pregrasp& b) {
    return a.q == b.q;
  };
  if (std::ranges::equal(grasps, listed_, same)) {
    return;
  }
  const int before = list_->indexOfTopLevelItem(list_->currentItem());
  int row = 0;
  if (is_chosen_ && before >= 0) {
    const auto& chosen = listed_[static_cast<std::size_t>(before)];
    const auto now =
        std::ranges::find_if(grasps, [&](const auto& grasp) { return same(grasp, chosen); });
    row = now == grasps.end() ? 0 : static_cast<int>(now - grasps.begin());
  }
  const bool is_first = listed_.empty();
  listed_ = grasps;
  {
    const QSignalBlocker quiet(list_);
    list_->clear();
    for (std::size_t i = 0; i < grasps.size(); ++i) {
      auto* item = new QTreeWidgetItem(list_, row_texts(static_cast<int>(i) + 1, grasps[i]));
      for (int column = 0; column < list_->columnCount(); ++column) {
        item->setToolTip(column, row_tip(grasps[i]));
        item->setTextAlignment(column, column == 0 ? Qt::AlignRight : Qt::AlignHCenter);
      }
    }
  }
  list_->setCurrentItem(list_->topLevelItem(row));
  if (is_first) {
    fold_->setChecked(false);
  }
}

void GraspCard::show_failure(const QString& object, const QString& reason) {
  title_->setText(tr("Grasp %1").arg(object));
  set_up(reason, false, false);
}

int GraspCard::row() const { return list_->indexOfTopLevelItem(list_->currentItem()); }

void GraspCard::show_tests(bool possible) { list_->setColumnHidden(kHeldColumn, !possible); }

void GraspCard::show_untested(const QString& reason) {
  show_tests(false);
  set_up(tr("Not simulated: %1").arg(reason), true, false);
}

void GraspCard::show_hold(int index, const planning::HoldResult& result) {
  QTreeWidgetItem* item = list_->topLevelItem(index);
  if (item == nullptr) {
    return;
  }
  item->setText(kHeldColumn, hold_text(result));
  item->setToolTip(kHeldColumn, hold_tip(result));
  update_film();
}

void GraspCard::update_film() {
  const QTreeWidgetItem* item = list_->currentItem();
  film_->setEnabled(item != nullptr && !item->text(kHeldColumn).isEmpty());
}

void GraspCard::show_film(const QString& what) {
  if (note_before_film_.isEmpty()) {
    note_before_film_ = note_->text();
  }
  film_->setChecked(!what.isEmpty());
  film_->setText(what.isEmpty() ? tr("Watch the test") : tr("Stop"));
  note_->setText(what.isEmpty() ? std::exchange(note_before_film_, QString()) : what);
}

void GraspCard::set_up(const QString& note, bool with_list, bool searching) {
  note_->setText(note);
  search_->setVisible(searching);
  list_->setVisible(with_list);
  plan_->setVisible(with_list);
  film_->setVisible(with_list && !list_->isColumnHidden(kHeldColumn));
  film_bar_->setVisible(film_->isVisibleTo(this));
  fold_->setVisible(with_list);
  appear();
}

void GraspCard::place() {
  const QRect within = parentWidget()->rect().adjusted(kMargin, kMargin, -kMargin, -kMargin);
  const int width = std::min(scaled(kWidth), within.width());
  const auto height_with = [this, width](int rows) {
    list_->setFixedHeight(list_->header()->sizeHint().height() + rows * list_->sizeHintForRow(0) +
                          2);
    details_->layout()->activate();
    return layout()->totalHeightForWidth(width);
  };
  int rows = list_->topLevelItemCount();
  int height = height_with(rows);
  while (height > within.height() && rows > kFewestRows) {
    height = height_with(--rows);
  }
  stand_where_it_hides_least({width, std::min(height, within.height())}, to_be_seen_());
}

GraspTool::GraspTool(Document& document, SceneEditor& editor, PlanningSession& session,
                     SceneView& view, planning::MakeHoldTest make_hold_test, QObject* parent)
    : QObject(parent),
      document_(document),
      editor_(editor),
      session_(session),
      view_(view),
      card_(new GraspCard(&view, [this] { return to_be_seen(); })),
      make_hold_test_(make_hold_test) {
  card_->show_tests(make_hold_test_ != nullptr);
  connect(&card_->film(), &FilmBar::shown, this, &GraspTool::show_frame);
  connect(&card_->film(), &FilmBar::ended, this, &GraspTool::show_scene);
  connect(card_, &GraspCard::film_wanted, this,
          [this](int index, bool wanted) { wanted ? begin_film(index) : card_->film().end(); });
  connect(&document_, &Document::opened, this, &GraspTool::end);
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene()) {
      end();  // what was found is of another scene
    }
  });
  connect(&session_, &PlanningSession::started, this, &GraspTool::end);  // to another goal
  connect(card_, &GraspCard::looked_at, this, &GraspTool::look_at);
  connect(card_, &GraspCard::chosen, this, &GraspTool::choose);
  connect(card_, &GraspCard::closed, this, &GraspTool::end);
  connect(card_, &GraspCard::stop_requested, this, [this] {
    if (ends_search_) {
      ends_search_->request_stop();
    }
  });
  connect(&test_job_, &LatestJob::failed, card_, &GraspCard::show_untested);
  connect(&job_, &LatestJob::failed, this, [this](const QString& reason) {
    card_->show_failure(QString::fromStdString(object_), reason);
  });
}

void GraspTool::begin() {
  const geometric::SceneObject* object = editor_.selected_object();
  if (!object || !document_.problem()) {
    return;
  }
  emit handles_welcome(false);
  object_ = object->name;
  card_->film().end();
  test_job_.cancel();
  tests_.clear();
  grasps_ = {};
  card_->show_tests(make_hold_test_ != nullptr);
  card_->show_search(QString::fromStdString(object->name));
  ends_search_ = std::make_shared<std::stop_source>();
  // Without a start the motion begins where the robot is shown. Of size 0: the scene has a start.
  geometric::Configuration from;
  if (!document_.scene()->start) {
    from = document_.configuration();
  }
  job_.run([this, name = object->name, problem = document_.problem(), search = ++search_, from,
            ends = ends_search_](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem prepared = problem->wait(stop);
    if (!prepared) {
      return nullptr;
    }
    planning::PlanningProblem asked = *prepared;
    asked.start = from.size() > 0 ? from : asked.start;
    Eigen::Vector3d centre_O = Eigen::Vector3d::Zero();
    if (const auto* grasped = geometric::find_object(*prepared->scene, name)) {
      centre_O = planning::torque_scale(*geometric::tessellate(grasped->shape)).centre_O;
    }
    const std::stop_callback on_cancel(stop, [&ends] { ends->request_stop(); });
    const auto progress = [this, search, centre_O](const std::vector<planning::Pregrasp>& found,
                                                   double fraction) {
      QMetaObject::invokeMethod(
          this,
          [this, search, centre_O, found, fraction] {
            if (search == search_) {
              centre_O_ = centre_O;
            }
            take_progress(search, found, fraction);
          },
          Qt::QueuedConnection);
    };
    return
        [this, title = QString::fromStdString(name), revision = problem->revision(), ends, centre_O,
         found = planning::find_pregrasps(asked, name, {}, ends->get_token(), progress)] {
          ++search_;  // no progress after the end
          centre_O_ = centre_O;
          grasps_ = {found.found, revision};
          if (grasps_.value.empty()) {
            card_->show_failure(title, ends->stop_requested()
                                           ? tr("The search was stopped before a grasp was found.")
                                           : QString::fromStdString(found.why_none));
          } else {
            card_->show_grasps(grasps_.value, ends->stop_requested());
            test(found.palm);
          }
        };
  });
}

void GraspTool::take_progress(int search, std::vector<planning::Pregrasp> found, double fraction) {
  if (search != search_ || !job_.is_busy()) {
    return;
  }
  grasps_ = {std::move(found), document_.revision()};
  card_->show_progress(grasps_.value, fraction);
}

void GraspTool::look_at(int index) {
  card_->film().end();
  const planning::Pregrasp& grasp = grasps_.value[static_cast<std::size_t>(index)];
  view_.preview_ghost(false, grasp.closed.size() > 0 ? grasp.closed : grasp.q);
  const geometric::SceneObject* object = geometric::find_object(*document_.scene(), object_);
  if (object == nullptr) {
    return;
  }
  view_.set_overlay(Overlay::kGrasp, make_grasp_node(object->X_PO, centre_O_, grasp,
                                                     planning::PregraspOptions{}.contact.friction));
}

void GraspTool::test(int palm) {
  tests_.clear();
  if (make_hold_test_ == nullptr) {
    return;
  }
  test_job_.run([this, palm, make = make_hold_test_, name = object_, search = search_,
                 grasps = grasps_.value,
                 problem = document_.problem()](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem prepared = problem->wait(stop);
    if (!prepared) {
      return nullptr;
    }
    const auto hold_test = make(*prepared, name, palm);
    for (const planning::Pregrasp& grasp : grasps) {
      FilmedTest filmed;
      filmed.result = hold_test->test(grasp, {}, stop, [&filmed](const planning::HoldFrame& frame) {
        filmed.frames.push_back(frame);
      });
      if (stop.stop_requested()) {
        return nullptr;
      }
      QMetaObject::invokeMethod(
          this, [this, search, filmed = std::move(filmed)] { take_test(search, filmed); },
          Qt::QueuedConnection);
    }
    return nullptr;
  });
}

void GraspTool::take_test(int search, FilmedTest test) {
  if (search != search_ || tests_.size() >= grasps_.value.size()) {
    return;
  }
  tests_.push_back(std::move(test));
  card_->show_hold(static_cast<int>(tests_.size()) - 1, tests_.back().result);
}

void GraspTool::begin_film(int index) {
  filmed_ = static_cast<std::size_t>(index);
  if (filmed_ >= tests_.size()) {
    return;
  }
  view_.preview_ghost(false, std::nullopt);
  card_->film().begin(static_cast<int>(tests_[filmed_].frames.size()));
}

void GraspTool::show_frame(int index) {
  const planning::HoldFrame& frame = tests_[filmed_].frames[static_cast<std::size_t>(index)];
  view_.set_configuration(frame.q);
  view_.preview(object_item(object_), frame.X_WO);
  view_.set_overlay(Overlay::kGrasp, make_forces_node(frame.forces));
  card_->show_film(load_text(frame.load));
}

void GraspTool::show_scene() {
  card_->show_film({});
  const std::shared_ptr<const geometric::Scene> scene = document_.scene();
  const auto* object = scene ? geometric::find_object(*scene, object_) : nullptr;
  if (object != nullptr) {
    view_.preview(object_item(object_), object->X_PO);
  }
  if (document_.robot()) {
    view_.set_configuration(document_.configuration());
  }
  if (grasps_.made_from == document_.revision() && filmed_ < grasps_.value.size()) {
    look_at(static_cast<int>(filmed_));
  }
}

void GraspTool::end() {
  card_->film().end();
  job_.cancel();
  test_job_.cancel();
  tests_.clear();
  view_.set_overlay(Overlay::kGrasp, nullptr);
  ++search_;
  card_->hide();
  emit handles_welcome(true);
  if (!std::exchange(grasps_, {}).value.empty() && document_.robot()) {
    view_.preview_ghost(false, document_.scene()->goal);
  }
}

std::vector<QPoint> GraspTool::to_be_seen() const {
  std::vector<QPoint> places;
  const auto add = [&](const Eigen::Vector3d& point) {
    if (view_.camera().place_of(point)) {  // it is before the camera
      places.push_back(place_of(view_.camera(), view_.size(), point).toPoint());
    }
  };
  const geometric::Scene* scene = document_.scene().get();
  if (!scene || !geometric::find_object(*scene, object_)) {
    return places;
  }
  const geometric::Aabb box = geometric::bounds(*scene, document_.configuration(), {object_});
  for (int corner = 0; corner < 8; ++corner) {
    add({(corner & 1) ? box.upper.x() : box.lower.x(), (corner & 2) ? box.upper.y() : box.lower.y(),
         (corner & 4) ? box.upper.z() : box.lower.z()});
  }
  const geometric::RobotInstance& robot = *document_.robot();
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  for (const planning::Pregrasp& grasp : grasps_.value) {
    robot.model->forward_kinematics(grasp.q, X_BL);
    for (int link = document_.palm(); link < robot.model->link_count(); ++link) {
      if (link == document_.palm() ||
          std::ranges::count(document_.joints().hand, robot.model->mimic_mapping(link).variable) >
              0) {
        add(robot.X_WB * X_BL[static_cast<std::size_t>(link)] *
            planning::middle_of(robot.model->link(link)));
      }
    }
  }
  return places;
}

void GraspTool::choose(int index) {
  if (grasps_.made_from != document_.revision()) {
    end();
    return;
  }
  const geometric::Configuration q = grasps_.value[static_cast<std::size_t>(index)].q;
  editor_.set_goal(q, document_.configuration());
  emit planning();
  session_.start();
}

void add_grasping(Workbench& workbench) {
  auto& tool = workbench.own<GraspTool>(workbench.document, workbench.editor, workbench.session,
                                        workbench.view, workbench.plugins->hold_test_maker());
  QAction* grasp = workbench.make_action(
      QStringLiteral("posture"), QObject::tr("&Grasp…"), QKeySequence(QStringLiteral("Ctrl+G")),
      QObject::tr("Find grasps of the object, choose one and plan to it"));
  workbench.add_to_menu(MainMenu::kEdit, {3, 0}, grasp);
  workbench.add_to_menu(MainMenu::kContext, {3, 0}, grasp);
  workbench.add_to_bar(MainBar::kEditing, {0, 50}, grasp);
  const auto update_enabled = [grasp, &workbench] {
    const geometric::SceneObject* object = workbench.editor.selected_object();
    allow(*grasp, !workbench.document.robot() ? QObject::tr("The scene has no robot.")
                  : !object                   ? QObject::tr("Select an object first.")
                  : object->attachment ? QObject::tr("The robot holds it already: detach it first.")
                                       : QString());
  };
  QObject::connect(grasp, &QAction::triggered, &tool, &GraspTool::begin);
  QObject::connect(&tool, &GraspTool::handles_welcome, &workbench, &Workbench::handles_welcome);
  QObject::connect(&tool, &GraspTool::planning, &workbench,
                   [&workbench] { workbench.show_panel("plan"); });
  QObject::connect(&workbench.document, &Document::opened, grasp, update_enabled);
  QObject::connect(&workbench.document, &Document::edited, grasp, update_enabled);
  QObject::connect(&workbench.editor, &SceneEditor::selection_changed, grasp, update_enabled);
  update_enabled();
}

}  // namespace handway::gui
