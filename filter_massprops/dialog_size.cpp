#include "filter_massprops/dialog_size.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QEvent>
#include <QGridLayout>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTimerEvent>

#include <algorithm>

namespace massprops {
namespace {

/// As large as what it shows, where there is room; never too narrow, also when the help is shown.
class ParameterArea : public QScrollArea {
public:
  using QScrollArea::QScrollArea;

  QSize sizeHint() const override { return besidesBar(widget()->sizeHint()); }

  bool eventFilter(QObject* shown, QEvent* event) override {
    if (shown == widget() && event->type() == QEvent::LayoutRequest) {
      setMinimumWidth(besidesBar(widget()->minimumSizeHint()).width());
    }
    return QScrollArea::eventFilter(shown, event);
  }

private:
  QSize besidesBar(const QSize& size) const {
    return size + QSize(verticalScrollBar()->sizeHint().width(), 0);
  }
};

/// Lists and numbers do not change under the mouse wheel: it scrolls.
class WheelScrolls : public QObject {
public:
  explicit WheelScrolls(QWidget* parameters) : QObject(parameters) {
    const auto watch = [this](const auto& fields) {
      for (QWidget* field : fields) {
        field->setFocusPolicy(Qt::StrongFocus);
        field->installEventFilter(this);
      }
    };
    watch(parameters->findChildren<QComboBox*>());
    watch(parameters->findChildren<QAbstractSpinBox*>());
  }

  bool eventFilter(QObject* /*field*/, QEvent* event) override {
    if (event->type() != QEvent::Wheel) return false;
    event->ignore();
    return true;
  }
};

/// The dialog of MeshLab 2020.09 has a grid of the filter's text, the parameters and the buttons.
void letParametersScroll(QDockWidget& dialog) {
  QWidget* const content = dialog.widget();
  auto* const grid = qobject_cast<QGridLayout*>(content == nullptr ? nullptr : content->layout());
  QLayoutItem* const item = grid == nullptr ? nullptr : grid->itemAtPosition(1, 0);
  QWidget* const parameters = item == nullptr ? nullptr : item->widget();
  if (parameters == nullptr) return;
  auto* const area = new ParameterArea(content);
  area->setFrameShape(QFrame::NoFrame);
  area->setWidgetResizable(true);
  delete grid->replaceWidget(parameters, area);
  area->setWidget(parameters);
  area->setMinimumWidth(area->sizeHint().width());
  new WheelScrolls(parameters);
}

void fitToScreen(QDockWidget& dialog) {
  const QRect screen = dialog.screen()->availableGeometry();
  const QSize most = screen.size() - (dialog.frameGeometry().size() - dialog.size());
  auto* const area = dialog.findChild<QScrollArea*>();
  if (area == nullptr) {
    const int height = dialog.height();
    letParametersScroll(dialog);
    // MeshLab shrinks its dialog to this size when the help is shown or hidden.
    dialog.setMinimumSize(dialog.minimumSizeHint().width(), std::min(height, most.height()));
    dialog.resize(dialog.minimumSize());
  } else if (dynamic_cast<ParameterArea*>(area) == nullptr && area->widget() != nullptr) {
    new WheelScrolls(area->widget());
  }
  if (!dialog.isFloating()) return;
  dialog.resize(dialog.size().boundedTo(most));
  const QSize room = most - dialog.size();
  const QPoint corner = dialog.pos() - screen.topLeft();
  dialog.move(screen.topLeft() + QPoint(std::clamp(corner.x(), 0, std::max(room.width(), 0)),
                                        std::clamp(corner.y(), 0, std::max(room.height(), 0))));
}

/// Waits until the dialog is there.
class Waiting : public QObject {
public:
  explicit Waiting(const char* title) : QObject(qApp), title_(title) { startTimer(0); }

  void timerEvent(QTimerEvent* event) override {
    killTimer(event->timerId());
    const QWidgetList widgets = QApplication::allWidgets();
    for (QWidget* widget : widgets) {
      auto* const dialog = qobject_cast<QDockWidget*>(widget);
      if (dialog != nullptr && dialog->isVisible() && dialog->windowTitle() == title_) {
        fitToScreen(*dialog);
      }
    }
    deleteLater();
  }

private:
  QString title_;
};

} // namespace

void fitDialogToScreen(const char* title) {
  new Waiting(title);
}

} // namespace massprops
