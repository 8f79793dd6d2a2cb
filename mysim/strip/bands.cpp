#include "mysim/strip/bands.h"

#include <algorithm>
#include <cstring>

namespace crosscheck::strip {
namespace {

constexpr int reach = 2;  // rows

/// Bands of rows that are at least twice as many as their neighbours take.
int count_of(int rows, int threads) { return std::clamp(rows / (2 * reach), 1, std::max(threads, 1)); }

}  // namespace

template <class T>
Bands<T>::Bands(const Weave& weave, int threads) : columns_(weave.columns), crew_(count_of(weave.rows, threads)) {
  const int count = crew_.size();
  for (int i = 0; i < count; ++i) {
    const int begin = static_cast<int>(static_cast<long>(weave.rows) * i / count),
              end = static_cast<int>(static_cast<long>(weave.rows) * (i + 1) / count);
    const int lead = i > 0 ? reach : 0, tail = i + 1 < count ? reach : 0;
    Weave part = weave;
    part.rows = lead + end - begin + tail;
    bands_.push_back({i, SheetBody<T>(part), (begin - lead) * columns_, lead, end - begin, {}, {}});
    Band& band = bands_.back();
    band.body.sheet().lead = lead, band.body.sheet().tail = tail;
    if (count > 1)
      for (Lines<T>& left : band.left) left = Lines<T>(2 * reach * band.body.row_length());
  }
}

template <class T>
void Bands<T>::put(const Points& x, const Points& v) {
  for (size_t i = 0; i < bands_.size(); ++i) {
    bands_[i].body.put(x.middleCols(bands_[i].first, bands_[i].body.size()),
                       v.middleCols(bands_[i].first, bands_[i].body.size()));
    leave(static_cast<int>(i), turn_);
  }
}

template <class T>
void Bands<T>::get(Points& x, Points& v) const {
  for (const Band& band : bands_) band.body.get(band.lead, band.own, band.first, x, v);
}

template <class T>
void Bands<T>::take(int which) {
  Band& band = bands_[which];
  const long row = band.body.row_length();
  const auto copy = [row](T* to, const T* from) { std::memcpy(to, from, reach * row * sizeof(T)); };
  if (which > 0) copy(band.body.row(0), bands_[which - 1].left[turn_].data() + reach * row);
  if (which + 1 < static_cast<int>(bands_.size()))
    copy(band.body.row(band.lead + band.own), bands_[which + 1].left[turn_].data());
}

template <class T>
void Bands<T>::leave(int which, int turn) {
  if (bands_.size() == 1) return;
  Band& band = bands_[which];
  const long row = band.body.row_length();
  T* to = band.left[turn].data();
  std::memcpy(to, band.body.row(band.lead), reach * row * sizeof(T));
  std::memcpy(to + reach * row, band.body.row(band.lead + band.own - reach), reach * row * sizeof(T));
}

template class Bands<double>;
template class Bands<float>;

}  // namespace crosscheck::strip
