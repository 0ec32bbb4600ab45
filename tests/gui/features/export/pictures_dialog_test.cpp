#include "features/export/pictures_dialog.h"

#include "features/export/film_parts.h"
#include "patience.h"
#include "watched_application.h"
#include "window_test.h"

#include <QAction>
#include <QComboBox>
#include <QImage>
#include <QLabel>
#include <QProcess>
#include <QPushButton>
#include <QSignalSpy>
#include <QThreadPool>

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <utility>

namespace handway::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Limits the size of files of this program as long as it lives, like a full disk.
class LimitedFiles {
 public:
  explicit LimitedFiles(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~LimitedFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  LimitedFiles(const LimitedFiles&) = delete;
  LimitedFiles& operator=(const LimitedFiles&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = SIG_DFL;
};

class Pictures : public WindowTest {
 protected:
  void SetUp() override {
    path_ = qgetenv("PATH");
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      plan();
      ASSERT_TRUE(QTest::qWaitFor([&] { return window().player().timeline().motion() != nullptr; },
                                  kPatienceMs));
    }
  }
  void TearDown() override {
    qputenv("PATH", path_);
    WindowTest::TearDown();
  }

  /// Makes the script the program that is found as ffmpeg.
  void use_program(const std::string& script) const {
    const fs::path folder = cell().folder() / "bin";
    fs::create_directories(folder);
    std::ofstream(folder / "ffmpeg") << "#!/bin/sh\n" << script;
    fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
    qputenv("PATH", QByteArray::fromStdString(folder.string()) + ":/usr/bin:/bin");
  }
  [[nodiscard]] gui::PicturesDialog& begin() const {
    part<QAction>("pictures").trigger();
    return *window().findChild<gui::PicturesDialog*>();
  }
  [[nodiscard]] std::string note(const gui::PicturesDialog& dialog) const {
    return dialog.findChild<QLabel*>(QStringLiteral("pictures_note"))->text().toStdString();
  }
  void press(const gui::PicturesDialog& dialog, const char* name) const {
    dialog.findChild<QPushButton*>(QLatin1String(name))->click();
  }
  [[nodiscard]] fs::path out(const char* name) const { return cell().folder() / name; }
  /// Waits for what the dialog has written.
  [[nodiscard]] bool exports(gui::PicturesDialog& dialog, const char* name) const {
    dialog.set_file(QString::fromStdString(out(name).string()));
    dialog.findChild<QComboBox*>(QStringLiteral("pictures_size"))->setCurrentIndex(0);
    dialog.findChild<QComboBox*>(QStringLiteral("pictures_rate"))->setCurrentIndex(0);
    QSignalSpy exported(&dialog, &gui::PicturesDialog::exported);
    press(dialog, "pictures_export");
    return QTest::qWaitFor([&] { return !exported.isEmpty() || !is_at_work(note(dialog)); },
                           kPatienceMs) &&
           !exported.isEmpty();
  }
  [[nodiscard]] static bool is_at_work(const std::string& note) {
    return note.starts_with("Taking") || note.starts_with("Drawing");
  }
  [[nodiscard]] int hidden_parts() const {
    return static_cast<int>(std::ranges::count_if(
        fs::directory_iterator(cell().folder()), [](const fs::directory_entry& entry) {
          return entry.path().filename().string().starts_with(".handway");
        }));
  }

 private:
  QByteArray path_;
};

TEST_F(Pictures, MakeAFilmStrip) {
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kStrip);
  ASSERT_TRUE(exports(dialog, "strip.png"));
  const QImage strip(QString::fromStdString(out("strip.png").string()));
  EXPECT_GT(strip.width(), 5 * strip.height());
}

TEST_F(Pictures, MakeAFolderOfFrames) {
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kFrames);
  ASSERT_TRUE(exports(dialog, "frames"));
  EXPECT_EQ(QImage(QString::fromStdString(out("frames/frame_00001.png").string())).size(),
            QSize(640, 360));
  const double pictures = std::ceil(10.0 * window().player().duration()) + 1.0;
  EXPECT_EQ(static_cast<double>(std::distance(fs::directory_iterator(out("frames")), {})),
            pictures);
  EXPECT_EQ(hidden_parts(), 0);
}

TEST_F(Pictures, RemoveWhatAProgramThatWasKilledHasLeft) {
  QProcess other;
  other.start(QStringLiteral("sleep"), {QStringLiteral("60")});
  ASSERT_TRUE(other.waitForStarted());
  const auto leave_parts = [&] {
    QTemporaryDir parts(gui::parts_beside(QString::fromStdString(out("film.mp4").string())));
    parts.setAutoRemove(false);
    std::string name = fs::path(parts.path().toStdString()).filename().string();
    const std::string ours = std::to_string(QCoreApplication::applicationPid());
    name.replace(name.rfind(ours + "-"), ours.size(), std::to_string(other.processId()));
    fs::rename(parts.path().toStdString(), cell().folder() / name);
    std::ofstream(cell().folder() / name / "frame_00001.png") << "a part";
  };
  leave_parts();
  const auto export_frames = [this](const char* name) {
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    gui::PicturesDialog& dialog = begin();
    dialog.choose(gui::PicturesDialog::Kind::kFrames);
    return exports(dialog, name);
  };
  ASSERT_TRUE(export_frames("frames"));
  QThreadPool::globalInstance()->waitForDone();
  EXPECT_EQ(hidden_parts(), 1) << "another program is at work";
  other.kill();
  other.waitForFinished();
  ASSERT_TRUE(export_frames("more_frames"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return hidden_parts() == 0; }));
}

TEST_F(Pictures, DoNotTouchAFolderThatIsThere) {
  fs::create_directory(out("frames"));
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kFrames);
  EXPECT_FALSE(exports(dialog, "frames"));
  EXPECT_THAT(note(dialog), HasSubstr("a file or folder of that name"));
}

TEST_F(Pictures, GoToFfmpegAsTheyAre) {
  use_program("for last; do :; done\nexec cat > \"$last\"\n");
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kFilm);
  ASSERT_TRUE(exports(dialog, "film.mp4")) << note(dialog);
  const double pictures = std::ceil(10.0 * window().player().duration()) + 1.0;
  EXPECT_EQ(static_cast<double>(fs::file_size(out("film.mp4"))), pictures * 640 * 360 * 3);
  EXPECT_EQ(hidden_parts(), 0);
}

TEST_F(Pictures, SayWhatFfmpegSaysAndLeaveNothing) {
  use_program("echo 'no such encoder' >&2\nexit 1\n");
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kAnimation);
  EXPECT_FALSE(exports(dialog, "film.gif"));
  EXPECT_THAT(note(dialog), HasSubstr("no such encoder"));
  EXPECT_FALSE(fs::exists(out("film.gif")));
  EXPECT_TRUE(QTest::qWaitFor([&] { return hidden_parts() == 0; }));
}

TEST_F(Pictures, SayThatFfmpegIsMissing) {
  qputenv("PATH", "/nowhere");
  const gui::PicturesDialog& dialog = begin();
  EXPECT_THAT(note(dialog), HasSubstr("ffmpeg, which is not installed"));
}

TEST_F(Pictures, KeepTheWindowAlive) {
  // 50 ms are wanted; a busy machine may make three times that of it.
  constexpr double kLongestMs = 150.0;
  for (const auto& [kind, name] : {std::pair(gui::PicturesDialog::Kind::kStrip, "alive.png"),
                                   {gui::PicturesDialog::Kind::kFrames, "alive"}}) {
    gui::PicturesDialog& dialog = begin();
    dialog.choose(kind);
    WatchedApplication::forget();
    ASSERT_TRUE(exports(dialog, name)) << note(dialog);
    const Stall& stall = WatchedApplication::longest();
    EXPECT_LT(stall.ms, kLongestMs) << name << ": " << stall.event.toStdString();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
}

TEST_F(Pictures, SayInWordsThatTheDiskIsFull) {
  fs::create_symlink("/dev/full", out("strip.png"));
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kStrip);
  EXPECT_FALSE(exports(dialog, "strip.png"));
  EXPECT_THAT(note(dialog), HasSubstr("No space left on device"));
}

TEST_F(Pictures, SayWhyAFrameCannotBeWrittenAndLeaveNothing) {
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kFrames);
  {
    const LimitedFiles no_larger_than_this(100);
    EXPECT_FALSE(exports(dialog, "frames"));
  }
  EXPECT_THAT(note(dialog), HasSubstr("frame_0"));
  EXPECT_THAT(note(dialog), HasSubstr("can't be written: File too large"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return hidden_parts() == 0; }));
  EXPECT_FALSE(fs::exists(out("frames")));
}

TEST_F(Pictures, LeaveNoStripThatWasCancelled) {
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kStrip);
  dialog.set_file(QString::fromStdString(out("strip.png").string()));
  press(dialog, "pictures_export");
  ASSERT_TRUE(QTest::qWaitFor([&] { return note(dialog).starts_with("Drawing"); }, kPatienceMs));
  press(dialog, "pictures_close");
  EXPECT_THAT(note(dialog), HasSubstr("Cancelled"));
  QTest::qWait(300);
  EXPECT_FALSE(fs::exists(out("strip.png")));
}

TEST_F(Pictures, LeaveNothingWhenCancelled) {
  gui::PicturesDialog& dialog = begin();
  dialog.choose(gui::PicturesDialog::Kind::kFrames);
  dialog.set_file(QString::fromStdString(out("frames").string()));
  press(dialog, "pictures_export");
  press(dialog, "pictures_close");
  EXPECT_THAT(note(dialog), HasSubstr("Cancelled"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return hidden_parts() == 0; }));
  EXPECT_FALSE(fs::exists(out("frames")));
}

}  // namespace
}  // namespace handway::test
