// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "line_plot.h"

#include "common_options.h"
#include "plot_axis.h"

#include <cairo/cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

namespace pcl_nurbs_tools {
namespace {

constexpr int kWidth = 1000; // pixels
constexpr int kHeight = 760;
constexpr double kLeft = 90.0;
constexpr double kRight = 30.0;
constexpr double kTop = 50.0;
constexpr double kBottom = 70.0;
constexpr double kFontSize = 15.0;

// Okabe and Ito's colours, which the colour-blind can tell apart.
constexpr std::array<std::array<double, 3>, 6> kColours = {{{0.0, 0.0, 0.0},
                                                            {0.835, 0.369, 0.0},
                                                            {0.0, 0.447, 0.698},
                                                            {0.0, 0.620, 0.451},
                                                            {0.8, 0.475, 0.655},
                                                            {0.902, 0.624, 0.0}}};

class PlotPainter {
public:
  explicit PlotPainter(const LinePlot& plot)
      : plot_(plot),
        surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, kWidth, kHeight),
                 cairo_surface_destroy),
        cairo_(cairo_create(surface_.get()), cairo_destroy)
  {
    chooseAxes();
  }

  std::string
  paint()
  {
    cairo_set_source_rgb(cairo_.get(), 1, 1, 1);
    cairo_paint(cairo_.get());
    cairo_select_font_face(
        cairo_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_.get(), kFontSize);
    paintGrid();
    paintLabels();
    paintLines();
    paintLegend();
    return encoded();
  }

private:
  void
  chooseAxes()
  {
    const double infinity = std::numeric_limits<double>::infinity();
    double low_x = infinity;
    double low_y = infinity;
    double high_x = -infinity;
    double high_y = -infinity;
    for (const PlotLine& line : plot_.lines)
      for (const auto& [x, y] : line.points) {
        if (!std::isfinite(x) || !std::isfinite(y))
          continue;
        low_x = std::min(low_x, x);
        high_x = std::max(high_x, x);
        low_y = std::min(low_y, y);
        high_y = std::max(high_y, y);
      }
    x_ = axisOver(low_x, high_x);
    y_ = axisOver(low_y, high_y);
    if (!plot_.same_scale)
      return;
    const double unit =
        std::max((x_.high - x_.low) / innerWidth(), (y_.high - y_.low) / innerHeight());
    widen(x_, unit * innerWidth());
    widen(y_, unit * innerHeight());
  }

  static double
  innerWidth()
  {
    return kWidth - kLeft - kRight;
  }

  static double
  innerHeight()
  {
    return kHeight - kTop - kBottom;
  }

  double
  column(double x) const
  {
    return kLeft + (x - x_.low) / (x_.high - x_.low) * innerWidth();
  }

  double
  row(double y) const
  {
    return kTop + (y_.high - y) / (y_.high - y_.low) * innerHeight();
  }

  /** Text about a place: \a across and \a down are the shares of its size left of and
   * above the place. */
  void
  text(double x, double y, const std::string& words, double across, double down) const
  {
    cairo_text_extents_t size;
    cairo_text_extents(cairo_.get(), words.c_str(), &size);
    cairo_move_to(cairo_.get(),
                  x - across * size.width - size.x_bearing,
                  y - down * size.height - size.y_bearing);
    cairo_show_text(cairo_.get(), words.c_str());
  }

  static std::string
  number(double value, double tick)
  {
    const int digits =
        std::clamp(-static_cast<int>(std::floor(std::log10(tick))), 0, 9);
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value + 0.0); // no -0
    return buffer.data();
  }

  void
  line(double x0, double y0, double x1, double y1) const
  {
    cairo_move_to(cairo_.get(), x0, y0);
    cairo_line_to(cairo_.get(), x1, y1);
    cairo_stroke(cairo_.get());
  }

  void
  paintGrid() const
  {
    constexpr double kGap = 8.0;
    cairo_set_line_width(cairo_.get(), 1.0);
    const auto grey = [&](double level) {
      cairo_set_source_rgb(cairo_.get(), level, level, level);
    };
    const auto firstTick = [](const Axis& axis) {
      return std::ceil(axis.low / axis.tick);
    };
    for (double k = firstTick(x_); k * x_.tick <= x_.high; ++k) {
      const double at = column(k * x_.tick);
      grey(0.88);
      line(at, kTop, at, kHeight - kBottom);
      grey(0.0);
      text(at, kHeight - kBottom + kGap, number(k * x_.tick, x_.tick), 0.5, 0.0);
    }
    for (double k = firstTick(y_); k * y_.tick <= y_.high; ++k) {
      const double at = row(k * y_.tick);
      grey(0.88);
      line(kLeft, at, kWidth - kRight, at);
      grey(0.0);
      text(kLeft - kGap, at, number(k * y_.tick, y_.tick), 1.0, 0.5);
    }
    grey(0.4);
    cairo_rectangle(cairo_.get(), kLeft, kTop, innerWidth(), innerHeight());
    cairo_stroke(cairo_.get());
  }

  void
  paintLabels() const
  {
    cairo_set_source_rgb(cairo_.get(), 0, 0, 0);
    text(0.5 * kWidth, 0.5 * kTop, plot_.title, 0.5, 0.5);
    text(kLeft + 0.5 * innerWidth(), kHeight - 12.0, plot_.x_label, 0.5, 1.0);
    cairo_save(cairo_.get());
    cairo_translate(cairo_.get(), 14.0, kTop + 0.5 * innerHeight());
    cairo_rotate(cairo_.get(), -M_PI_2);
    text(0.0, 0.0, plot_.y_label, 0.5, 0.0);
    cairo_restore(cairo_.get());
  }

  void
  chooseColour(std::size_t k) const
  {
    const std::array<double, 3>& colour = kColours[k % kColours.size()];
    cairo_set_source_rgb(cairo_.get(), colour[0], colour[1], colour[2]);
  }

  void
  paintLines() const
  {
    cairo_save(cairo_.get());
    cairo_rectangle(cairo_.get(), kLeft, kTop, innerWidth(), innerHeight());
    cairo_clip(cairo_.get());
    cairo_set_line_width(cairo_.get(), 2.0);
    cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
    for (std::size_t k = 0; k < plot_.lines.size(); ++k) {
      chooseColour(k);
      bool begun = false;
      for (const auto& [x, y] : plot_.lines[k].points) {
        const bool finite = std::isfinite(x) && std::isfinite(y);
        if (finite && begun)
          cairo_line_to(cairo_.get(), column(x), row(y));
        else if (finite)
          cairo_move_to(cairo_.get(), column(x), row(y));
        begun = finite;
      }
      cairo_stroke(cairo_.get());
    }
    cairo_restore(cairo_.get());
  }

  void
  paintLegend() const
  {
    constexpr double kSample = 30.0;
    double at = kTop + 20.0;
    for (std::size_t k = 0; k < plot_.lines.size(); ++k) {
      if (plot_.lines[k].name.empty())
        continue;
      chooseColour(k);
      cairo_set_line_width(cairo_.get(), 3.0);
      const double right = kWidth - kRight - 15.0;
      line(right - kSample, at, right, at);
      cairo_set_source_rgb(cairo_.get(), 0, 0, 0);
      text(right - kSample - 8.0, at, plot_.lines[k].name, 1.0, 0.5);
      at += 1.6 * kFontSize;
    }
  }

  std::string
  encoded() const
  {
    std::string bytes;
    const auto append = [](void* target, const unsigned char* data, unsigned length) {
      static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(data),
                                                length);
      return CAIRO_STATUS_SUCCESS;
    };
    if (cairo_surface_write_to_png_stream(surface_.get(), append, &bytes) !=
        CAIRO_STATUS_SUCCESS)
      throw std::bad_alloc();
    return bytes;
  }

  const LinePlot& plot_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo_;
  Axis x_;
  Axis y_;
};

} // namespace

void
writePlot(const std::string& path, const LinePlot& plot)
{
  writeText(path, PlotPainter(plot).paint());
}

} // namespace pcl_nurbs_tools
