#include "features/glove/calibration_choice.h"

#include <QFileDialog>
#include <QFileInfo>

#include <exception>

namespace handway::gui {
namespace {

constexpr int kTypical = 0;

}  // namespace

CalibrationChoice::CalibrationChoice(QWidget* parent) : QComboBox(parent) {
  setObjectName(QStringLiteral("glove_calibration"));
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMinimumContentsLength(10);
  addItem(tr("Typical right hand"));
  addItem(tr("From a file…"));
  setItemData(kTypical, tr("Generic calibration"), Qt::ToolTipRole);
  connect(this, qOverload<int>(&QComboBox::activated), this, &CalibrationChoice::choose);
}

void CalibrationChoice::load(const QString& file) {
  const device::GloveCalibration calibration = device::read_calibration(file.toStdString());
  int index = findData(file);
  if (index < 0) {
    index = count() - 1;
    insertItem(index, QFileInfo(file).fileName(), file);
  }
  setCurrentIndex(index);
  last_ = index;
  emit chosen(calibration);
}

void CalibrationChoice::choose(int index) {
  if (index == kTypical) {
    last_ = kTypical;
    emit chosen(std::nullopt);
    return;
  }
  QString file = itemData(index).toString();
  if (file.isEmpty()) {
    setCurrentIndex(last_);
    file = QFileDialog::getOpenFileName(this, tr("Open a calibration"), {},
                                        tr("Calibrations (*.yaml *.cal *.txt);;All files (*)"));
  }
  if (file.isEmpty()) {
    return;
  }
  try {
    load(file);
  } catch (const std::exception& error) {
    setCurrentIndex(last_);
    emit failed(QString::fromUtf8(error.what()));
  }
}

}  // namespace handway::gui
