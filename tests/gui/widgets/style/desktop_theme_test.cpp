/// Light or dark, as the desktop is.
#include "widgets/style/desktop_theme.h"

#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusVariant>
#include <QDBusVirtualObject>
#include <QProcess>
#include <QStandardPaths>
#include <QThread>

#include <gtest/gtest.h>

namespace handway::test {

namespace {

using gui::Theme;

/// Answers as the desktop's portal does: a variant in a variant.
class PortalSettings : public QDBusVirtualObject {
 public:
  explicit PortalSettings(uint scheme) : scheme_(scheme) {}

  [[nodiscard]] QString introspect(const QString& /*path*/) const override { return {}; }
  bool handleMessage(const QDBusMessage& question, const QDBusConnection& bus) override {
    const QVariantList wanted{QStringLiteral("org.freedesktop.appearance"),
                              QStringLiteral("color-scheme")};
    if (question.interface() != QLatin1String("org.freedesktop.portal.Settings") ||
        question.member() != QLatin1String("Read") || question.arguments() != wanted) {
      return false;
    }
    const QDBusVariant scheme{QVariant(scheme_)};
    return bus.send(
        question.createReply(QVariant::fromValue(QDBusVariant(QVariant::fromValue(scheme)))));
  }

 private:
  uint scheme_;
};

TEST(DesktopTheme, IsThatOfThePalette) {
  EXPECT_EQ(gui::theme_of(QPalette(Qt::black, Qt::white)), Theme::kLight);
  QPalette dark(QColor(0xee, 0xee, 0xee), QColor(0x2a, 0x2e, 0x32));
  dark.setColor(QPalette::WindowText, QColor(0xee, 0xee, 0xee));
  dark.setColor(QPalette::Window, QColor(0x2a, 0x2e, 0x32));
  EXPECT_EQ(gui::theme_of(dark), Theme::kDark);
}

/// A bus of its own.
class ThePortal : public ::testing::Test {
 protected:
  void SetUp() override {
    const QString program = QStandardPaths::findExecutable(QStringLiteral("dbus-daemon"));
    if (program.isEmpty()) {
      GTEST_SKIP() << "no dbus-daemon";
    }
    daemon_.start(program, {"--session", "--nofork", "--print-address"});
    ASSERT_TRUE(daemon_.waitForReadyRead());
    address_ = QString::fromUtf8(daemon_.readLine()).trimmed();
  }
  void TearDown() override {
    daemon_.kill();
    daemon_.waitForFinished();
  }

  [[nodiscard]] std::optional<Theme> asked() const {
    const QDBusConnection bus = QDBusConnection::connectToBus(address_, "asks");
    const std::optional<Theme> theme = gui::theme_of_portal(bus);
    QDBusConnection::disconnectFromBus("asks");
    return theme;
  }
  [[nodiscard]] std::optional<Theme> asked_of(uint scheme) const {
    QThread thread;
    PortalSettings portal(scheme);
    QDBusConnection bus = QDBusConnection::connectToBus(address_, "answers");
    portal.moveToThread(&thread);
    thread.start();
    EXPECT_TRUE(bus.registerVirtualObject("/org/freedesktop/portal/desktop", &portal) &&
                bus.registerService("org.freedesktop.portal.Desktop"));
    const std::optional<Theme> theme = asked();
    QDBusConnection::disconnectFromBus("answers");
    thread.quit();
    thread.wait();
    return theme;
  }

 private:
  QProcess daemon_;
  QString address_;
};

TEST_F(ThePortal, SaysWhatTheDesktopPrefers) {
  EXPECT_EQ(asked_of(1), Theme::kDark);
  EXPECT_EQ(asked_of(2), Theme::kLight);
  EXPECT_EQ(asked_of(0), std::nullopt);
}

TEST_F(ThePortal, MayBeMissing) { EXPECT_EQ(asked(), std::nullopt); }

}  // namespace
}  // namespace handway::test
