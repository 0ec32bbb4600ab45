#include "features/export/motion_preview.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/motion_text.h"
#include "widgets/plots/cursor_plot.h"
#include "widgets/plots/screen_colors.h"
#include "widgets/style/color_math.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QFontDatabase>
#include <QLabel>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QSplitter>
#include <QTabBar>
#include <QTabWidget>

#include <string>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

constexpr std::size_t kMostShown = 60000;  // characters of a file
constexpr int kNamesWidth = 170;

QColor hue_of(std::size_t index, std::size_t count) {
  constexpr int kWheel = 360;
  return seen_on(screen_colors().paper,
                 QColor::fromHsv(static_cast<int>(kWheel * index / count), 190, 190));
}

// The velocities of some of the joints as curves.
void draw(TimePlot& plot, const planning::Motion& motion, const std::vector<int>& variables) {
  plot.clear();
  std::vector<double> times;
  for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
    times.push_back(point.time);
  }
  for (std::size_t j = 0; j < variables.size(); ++j) {
    std::vector<double> values;
    for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
      values.push_back(geometric::degrees(point.velocity[variables[j]]));
    }
    const QString name = QString::fromStdString(motion.model->variable(variables[j]).name);
    plot.set_curve(plot.add_curve(name, hue_of(j, variables.size())), times, values);
  }
  plot.refresh();
}

}  // namespace

MotionPreview::MotionPreview(QWidget* parent)
    : QWidget(parent),
      tabs_(new QTabWidget),
      report_(named("export_report", new QLabel)),
      arm_(new TimePlot({}, tr("arm, °/s"))),
      hand_(new TimePlot(tr("time, s"), tr("hand, °/s"))),
      names_(named("export_files", new QListWidget)),
      content_(named("export_content", new QPlainTextEdit)) {
  tabs_->setDocumentMode(true);
  tabs_->tabBar()->setDrawBase(false);
  report_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  report_->setTextFormat(Qt::RichText);
  report_->setWordWrap(true);
  report_->setMargin(12);
  report_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  for (TimePlot* plot : {arm_, hand_}) {
    plot->set_colors(screen_colors());
  }
  names_->setAccessibleName(tr("Files"));
  content_->setAccessibleName(tr("Contents of the file"));
  content_->setReadOnly(true);
  content_->setLineWrapMode(QPlainTextEdit::NoWrap);
  content_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  auto* files = new QSplitter;
  files->addWidget(names_);
  files->addWidget(content_);
  files->setSizes({kNamesWidth, 3 * kNamesWidth});
  tabs_->addTab(report_, tr("Pre-flight"));
  tabs_->addTab(boxed(in_column({arm_, hand_}, 0)), tr("Velocities"));
  tabs_->addTab(files, tr("Files"));
  lay_out(*this, in_column({tabs_}));
  connect(names_, &QListWidget::currentRowChanged, this, &MotionPreview::show_file);
}

void MotionPreview::show_waiting(const QString& text) {
  report_->setText(colored(text, colors_of(current_theme()).muted));
  arm_->clear();
  hand_->clear();
  show_files({});
}

void MotionPreview::show_motion(const planning::TimedPath& motion,
                                const std::vector<std::string>& warnings) {
  QString text = motion_text(motion);
  for (const std::string& warning : warnings) {
    text += QStringLiteral("<br>") + colored(QString::fromStdString(warning), attention_color());
  }
  report_->setText(text);
  if (motion.cleared()) {
    show_velocities(motion.motion);
  }
}

void MotionPreview::show_velocities(const planning::Motion& motion) {
  draw(*arm_, motion, motion.arm);
  draw(*hand_, motion, motion.hand);
}

void MotionPreview::show_files(std::vector<planning::ExportedFile> files) {
  names_->clear();
  content_->clear();
  files_ = std::move(files);
  for (const planning::ExportedFile& file : files_) {
    names_->addItem(QString::fromStdString(file.name.string()));
  }
  names_->setCurrentRow(files_.empty() ? -1 : 0);
}

void MotionPreview::show_file(int row) {
  if (row < 0 || row >= static_cast<int>(files_.size())) {
    content_->clear();
    return;
  }
  const std::string& content = files_[static_cast<std::size_t>(row)].content;
  QString shown = QString::fromStdString(content.substr(0, kMostShown));
  if (content.size() > kMostShown) {
    shown += tr("\n… %1 characters more").arg(content.size() - kMostShown);
  }
  content_->setPlainText(shown);
}

}  // namespace handway::gui
