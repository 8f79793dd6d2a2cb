// Places labels where they cover nothing: at the ends of curves, along curves, or in a column next to the plot.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures/curve_plot.h"

namespace crosscheck {
namespace {

double distance(const Rect& r, Place p) {
  return std::hypot(std::max({0., r.left - p.x, p.x - r.right}), std::max({0., r.bottom - p.y, p.y - r.top}));
}

double nearest(const Rect& r, const std::vector<std::vector<Place>>& paths) {
  double least = 1e300;
  for (const auto& path : paths) {
    const size_t stride = 1 + path.size() / 200;
    for (size_t i = 0; i < path.size(); i += stride) least = std::min(least, distance(r, path[i]));
  }
  return least;
}

}  // namespace

std::string kind_of(const FailureMark& mark) {
  const size_t colon = mark.title.rfind(": ");
  return mark.kind == "failed" && colon != std::string::npos ? mark.title.substr(colon + 2) : mark.kind;
}

std::vector<std::pair<std::string, int>> mark_meanings(const Figure& f, double y_floor) {
  std::map<std::string, int> kinds;
  for (const FailureMark& mark : f.failures) kinds.emplace(kind_of(mark), mark.cross);
  std::vector<std::pair<std::string, int>> meanings(kinds.begin(), kinds.end());
  const auto has_scaled = [](const Curve& c) { return c.title == scaled_times && !c.points.empty(); };
  if (std::ranges::any_of(f.curves, has_scaled)) meanings.emplace_back("time scaled from a part", 6);
  const auto has_lower = [&](const Curve& c) {
    return c.title != scaled_times && std::ranges::any_of(c.points, [&](const auto& p) { return p.second < y_floor; });
  };
  if (std::ranges::any_of(f.curves, has_lower)) meanings.emplace_back("lower than the axis", 11);
  return meanings;
}

std::vector<std::vector<Place>> CurvePlot::paths_of(const NamedCurves& part) const {
  std::vector<std::vector<Place>> paths;
  for (const Curve* curve : part.curves) {
    paths.emplace_back();
    for (const auto& [x, y] : curve->points) {
      const Place p = place(x, y);
      const bool inside =
          p.x >= box_.left - 1 && p.x <= box_.right + 1 && p.y >= box_.bottom - 1 && p.y <= box_.top + 1;
      if (inside) paths.back().push_back(p);
    }
  }
  std::erase_if(paths, [](const auto& path) { return path.empty(); });
  return paths;
}

std::vector<Place> CurvePlot::crosses_of(const NamedCurves& part) const {
  std::vector<Place> all;
  for (const FailureMark* m : part.failures) all.push_back({place(m->x, y_low_).x, y_of_row(rows_.at(m))});
  return all;
}

void CurvePlot::fill_board() {
  board_.emplace(Rect{box_.left + 2, box_.right - 1, box_.bottom + 2, box_.top - 1});
  labels_.clear(), key_.clear(), done_.clear(), leaders_.clear();
  for (const NamedCurves& part : parts_) {
    for (const Curve* curve : part.curves) {
      std::vector<Place> path;
      for (const auto& [x, y] : curve->points) path.push_back(place(x, y));
      for (size_t i = 1; i < path.size() && curve->line; ++i) board_->add_line(path[i - 1], path[i], !part.coloured);
      if (curve->markers || !curve->line)
        for (const Place p : path) board_->add_mark(p);
    }
    for (const Place cross : crosses_of(part)) board_->add_mark(cross);
    if (!part.failures.empty())
      if (const auto sign = sign_of(part, rows_.at(part.failures[0]))) board_->add_mark(*sign);
  }
  for (size_t i = 1; i < f_.pareto.size(); ++i) {
    const Place a = place(f_.pareto[i - 1].first, f_.pareto[i - 1].second),
                b = place(f_.pareto[i].first, f_.pareto[i].second);
    board_->add_line(a, {b.x, a.y}, true), board_->add_line({b.x, a.y}, b, true);
  }
  for (const Guide& g : f_.guides)
    if (g.of_x && g.at > x_low_ && g.at < x_high_)
      board_->add_line(place(g.at, y_low_), {place(g.at, y_low_).x, box_.top});
}

/// Places a label nearer to its own curve than to others: at the end of the curve, along it, or next to a cross.
bool CurvePlot::place_beside(const std::string& words, const std::string& colour,
                             const std::vector<std::vector<Place>>& paths, const std::vector<Place>& marks,
                             const std::vector<std::vector<Place>>& others) {
  const double width = width_of(words), half = 6.2;
  double best = 60;  // if every place costs more, a key is easier to read
  std::optional<Rect> found;
  const auto attempt = [&](double left, double middle, double penalty) {
    const Rect r{left, left + width, middle - half, middle + half};
    const auto covered = board_->cost({r.left - 2, r.right + 2, r.bottom - 1, r.top + 1});
    if (!covered) return;
    double cost = penalty + *covered;
    if (cost >= best) return;
    const double own = std::min(nearest(r, paths), nearest(r, {marks})), other = nearest(r, others);
    if (other < own + 2) cost += 30;
    if (other < 12) cost += 12 - other;
    if (cost < best) best = cost, found = r;
  };
  const auto around = [&](Place p, double penalty, bool right, bool left) {
    for (const double away : {0., 4., 9.}) {
      if (right) attempt(p.x + 7 + away, p.y, penalty + away);
      if (left) attempt(p.x - 7 - away - width, p.y, penalty + 6 + away);
      for (const double side : {1., -1.})
        for (const double shift : {0.5, 0., 1., 0.25, 0.75})
          attempt(p.x - shift * width, p.y + side * (11 + away), penalty + 5 + away + 2 * std::abs(shift - 0.5));
    }
  };
  for (const auto& path : paths) {
    around(path.back(), 0, true, false);
    around(path.front(), 14, false, true);
    const size_t count = std::min<size_t>(path.size(), 24);
    for (size_t k = 1; k < count; ++k)
      around(path[path.size() - 1 - k * path.size() / count], 6 + 0.6 * double(k), false, false);
  }
  for (const Place p : marks) around(p, paths.empty() ? 0 : 30, true, true);
  if (!found) return false;
  labels_.push_back({{found->left, (found->bottom + found->top) / 2}, words, "left", colour});
  board_->add(*found);
  return true;
}

/// Returns false if there is no column of names yet, and a curve that ends at the right has no space for its label.
bool CurvePlot::place_names() {
  const bool column = column_ > 0;
  std::vector<size_t> missing, order;
  ending_right_.clear();
  long lines = 0;
  for (const bool coloured : {true, false})
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].coloured != coloured) continue;
      order.push_back(i);
      if (!parts_[i].has_line()) continue;
      lines += coloured;
      const auto paths = paths_of(parts_[i]);
      const double edge = box_.right - 0.06 * (box_.right - box_.left);
      if (is_short(parts_[i]) && std::ranges::any_of(paths, [&](const auto& p) { return p.back().x > edge; }))
        ending_right_.push_back(i);
    }
  bool others_named = std::ranges::any_of(done_, [&](size_t i) { return !parts_[i].coloured; });
  for (const size_t i : order) {
    const NamedCurves& part = parts_[i];
    if (done_.contains(i) || (!part.coloured && others_named)) continue;
    if (!named_in_key(f_, parts_, part) && is_short(part)) {
      std::vector<std::vector<Place>> others;
      for (size_t j = 0; j < parts_.size(); ++j)
        if (j != i && (part.coloured || parts_[j].coloured))
          for (auto& path : paths_of(parts_[j])) others.push_back(std::move(path));
      if (place_beside(part.name, part.coloured ? ink_of(part.style.colour) : grey_ink, paths_of(part),
                       crosses_of(part), others)) {
        done_.insert(i), others_named |= !part.coloured;
        continue;
      }
    }
    if (part.coloured) missing.push_back(i);
  }
  const auto is_coloured = [&](size_t i) { return parts_[i].coloured; };
  const long ends = std::ranges::count_if(ending_right_, is_coloured);
  if (!column && ends > 1 && 2 * ends >= lines &&
      std::ranges::any_of(missing, [&](size_t i) { return std::ranges::count(ending_right_, i) > 0; }))
    return false;
  for (const size_t i : missing) {
    MethodStyle style = parts_[i].style;
    const bool line = parts_[i].has_line();
    if (parts_[i].curves.empty()) style.marker = parts_[i].failures[0]->cross;
    key_.push_back({parts_[i].name, line ? KeyEntry::Kind::line : KeyEntry::Kind::mark, style});
  }
  for (size_t i = 0; i < parts_.size() && !others_named; ++i)
    if (!parts_[i].coloured) {
      others_named = true;
      const bool line = parts_[i].has_line();
      key_.push_back({parts_[i].name,
                      line ? KeyEntry::Kind::line : KeyEntry::Kind::mark,
                      {grey, "1",
                       line                       ? -1
                       : parts_[i].curves.empty() ? 2
                                                  : 6}});
    }
  return true;
}

/// Places names to the right of the plot, at the heights of their curves' ends. Moves overlapping names apart.
void CurvePlot::column_of_names() {
  struct Entry {
    size_t part;
    double end, y;
  };
  std::vector<Entry> entries;
  bool others = false;
  for (const size_t i : ending_right_) {
    if (!parts_[i].coloured && std::exchange(others, true)) continue;
    Place end{-1, 0};
    for (const auto& path : paths_of(parts_[i]))
      if (path.back().x > end.x) end = path.back();
    entries.push_back({i, end.y, end.y});
  }
  std::ranges::sort(entries, {}, &Entry::y);
  const double apart = 14, low = box_.bottom + 5, high = box_.top - 5;
  for (int pass = 0; pass < 200; ++pass)
    for (size_t k = 0; k < entries.size(); ++k) {
      if (k > 0 && entries[k].y < entries[k - 1].y + apart) {
        const double push = (entries[k - 1].y + apart - entries[k].y) / 2;
        entries[k].y += push, entries[k - 1].y -= push;
      }
      entries[k].y = std::clamp(entries[k].y, low + apart * static_cast<double>(k),
                                high - apart * static_cast<double>(entries.size() - 1 - k));
    }
  for (const Entry& e : entries) {
    const NamedCurves& part = parts_[e.part];
    MethodStyle style = part.coloured ? part.style : MethodStyle{grey, "1", -1};
    leaders_.push_back({{box_.right + 1, e.end}, {box_.right + 9, e.y}, style});
    labels_.push_back({{box_.right + (style.marker > 0 ? 20. : 12.), e.y},
                       part.name,
                       "left",
                       part.coloured ? ink_of(part.style.colour) : grey_ink});
    done_.insert(e.part);
  }
}

/// Places labels of straight lines and guides.
void CurvePlot::place_lines() {
  const auto beside = [&](double y, const std::string& words, const MethodStyle& style, bool in_key) {
    if (y < box_.bottom || y > box_.top) return;
    const double width = width_of(words), middle = (box_.left + box_.right - width) / 2;
    for (const double side : {1., -1.})
      for (const double left : {box_.right - width - 4, box_.left + 6, middle, (middle + box_.right - width) / 2,
                                (middle + box_.left) / 2}) {
        const Rect r{left, left + width, y + side * 9 - 6.2, y + side * 9 + 6.2};
        if (const auto cost = board_->cost(r); cost && *cost < 3) {
          labels_.push_back({{left, y + side * 9}, words, "left", grey_ink});
          return board_->add(r);
        }
      }
    if (in_key) key_.push_back({words, KeyEntry::Kind::line, style});
  };
  if (f_.floor && f_.floor->second > y_low_ && f_.floor->second < y_data_)
    beside(place(x_low_, f_.floor->second).y, f_.floor->first, {"#777777", "(2,3)", -1}, true);
  bool first = true;
  for (const Guide& g : f_.guides) {
    if (!g.of_x && g.at > y_low_ && g.at < y_data_) {
      const size_t unit = g.text.find(" %");
      beside(place(x_low_, g.at).y, first || unit == std::string::npos ? g.text : g.text.substr(0, unit + 2),
             {"#AAAAAA", "1", -1}, false);
      first = false;
    }
    if (g.of_x && g.at > x_low_ && g.at < x_high_) {
      const double x = place(g.at, y_low_).x, width = width_of(g.text);
      for (const double side : {-1., 1.})
        if (const Rect r{x + side * 9 - 6.2, x + side * 9 + 6.2, box_.bottom + 6, box_.bottom + 6 + width};
            board_->cost(r)) {
          labels_.push_back({{x + side * 9, box_.bottom + 6}, g.text, "left rotate by 90", grey_ink});
          board_->add(r);
          break;
        }
    }
  }
  if (f_.window) {
    const double x = std::max(box_.left, place(f_.window->first, y_low_).x) + 5, width = width_of(f_.window->second);
    bool placed = false;
    for (const double y : {box_.bottom + 10, box_.top - 10})
      if (const Rect r{x, x + width, y - 6.2, y + 6.2}; !placed && board_->cost(r).value_or(99) < 3) {
        labels_.push_back({{x, y}, f_.window->second, "left", grey_ink});
        board_->add(r), placed = true;
      }
    if (!placed) key_.push_back({"from the " + f_.window->second + " on", KeyEntry::Kind::box, {"#E4E4E0", "1", -1}});
  }
  if (!f_.pareto.empty()) {
    std::vector<std::vector<Place>> stairs(1);
    for (const auto& [x, y] : f_.pareto) stairs[0].push_back(place(x, y));
    std::vector<std::vector<Place>> others;
    for (const NamedCurves& part : parts_)
      if (part.coloured)
        for (auto& path : paths_of(part)) others.push_back(std::move(path));
    if (!place_beside(pareto_title, grey_ink, stairs, {}, others))
      key_.push_back({pareto_title, KeyEntry::Kind::line, {"#CCCCCC", "1", -1}});
  }
}

/// Puts the meanings of marks above the frame. If all crosses are of one kind, and there is space, puts their meaning
/// next to the rightmost cross of the top row instead.
void CurvePlot::place_kinds() {
  for (const auto& [words, marker] : mark_meanings(f_, y_floor_))
    remarks_.push_back({words, KeyEntry::Kind::mark, {"#444444", "1", marker}});
  std::set<std::string> kinds;
  Place last{0, -INFINITY};  // the rightmost cross of the top row
  for (const auto& [mark, row] : rows_) {
    const Place at{place(mark->x, y_low_).x, y_of_row(row)};
    kinds.insert(kind_of(*mark));
    if (at.y > last.y + 1 || (std::abs(at.y - last.y) < 1 && at.x > last.x)) last = at;
  }
  if (kinds.size() != 1) return;
  const Place at{last.x + 8, last.y};
  const Rect r{at.x, at.x + width_of(*kinds.begin()), at.y - 5, at.y + 5};
  if (!board_->cost(r)) return;
  labels_.push_back({at, *kinds.begin(), "left", "#444444"});
  board_->add(r);
  remarks_.erase(remarks_.begin());
}

}  // namespace crosscheck
