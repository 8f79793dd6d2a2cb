#include "mysim/strip/sheet_body.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace crosscheck::strip {
namespace {

constexpr size_t line_bytes = 64;

template <class T>
constexpr int block_size = 3 * lanes<T>;

}  // namespace

template <class T>
void Lines<T>::Free::operator()(T* memory) const {
  std::free(memory);
}

template <class T>
Lines<T>::Lines(size_t count) : size_(count) {
  const size_t bytes = (count * sizeof(T) + line_bytes - 1) / line_bytes * line_bytes + 2 * line_bytes;
  memory_.reset(static_cast<T*>(std::aligned_alloc(line_bytes, bytes)));
  if (!memory_) throw std::bad_alloc();
  std::fill_n(memory_.get(), bytes / sizeof(T), T(0));
  data_ = memory_.get() + line_bytes / sizeof(T);
}

template <class T>
SheetBody<T>::SheetBody(const Weave& weave)
    : rows_(weave.rows), columns_(weave.columns), blocks_((weave.columns + lanes<T> - 1) / lanes<T>) {
  const size_t row = static_cast<size_t>(before + blocks_ + after) * block_size<T>;
  x_ = Lines<T>(row * rows_);
  v_ = Lines<T>(static_cast<size_t>(blocks_) * block_size<T> * rows_);
  force_ = Lines<T>(3 * row);
  // lanes without a particle stay far from the others and from each other
  for (size_t i = 0; i < x_.size(); ++i) x_.data()[i] = T(1e6) + static_cast<T>(i % 4096) * T(17);
  sheet_ = {rows_, blocks_, 0, 0, x_.data(), v_.data(), force_.data(), {}, {}, nullptr, nullptr, nullptr, 0};
  for (int d = 0; d < directions; ++d) {
    if (!weave.families[d]) continue;
    k_[d] = Lines<T>(static_cast<size_t>(blocks_) * lanes<T>);
    for (int c = 0; c < columns_; ++c)
      if (const int to = c + direction[d].right; to >= 0 && to < columns_)
        k_[d].data()[c % blocks_ * lanes<T> + c / blocks_] = static_cast<T>(weave.families[d]->k);
    sheet_.k[d] = k_[d].data();
    sheet_.rest[d] = static_cast<T>(weave.families[d]->rest);
  }
}

template <class T>
long SheetBody<T>::x_at(int particle) const {
  const int row = particle / columns_, column = particle % columns_;
  return (static_cast<long>(row) * (before + blocks_ + after) + before + column % blocks_) * block_size<T> +
         column / blocks_;
}

template <class T>
long SheetBody<T>::v_at(int particle) const {
  const int row = particle / columns_, column = particle % columns_;
  return (static_cast<long>(row) * blocks_ + column % blocks_) * block_size<T> + column / blocks_;
}

template <class T>
void SheetBody<T>::place(int particle, const Vec3& x) {
  const int column = particle % columns_, block = column % blocks_;
  T *to = x_.data() + x_at(particle), *v = v_.data() + v_at(particle);
  for (int c = 0; c < 3; ++c) {
    to[c * lanes<T>] = static_cast<T>(x[c]), v[c * lanes<T>] = 0;
    if (block < after && column >= blocks_) to[blocks_ * block_size<T> + c * lanes<T> - 1] = static_cast<T>(x[c]);
    if (block == blocks_ - 1 && column + 1 < blocks_ * lanes<T> && column / blocks_ + 1 < lanes<T>)
      to[-blocks_ * block_size<T> + c * lanes<T> + 1] = static_cast<T>(x[c]);
  }
}

template <class T>
void SheetBody<T>::put(const Eigen::Ref<const Points>& x, const Eigen::Ref<const Points>& v) {
  for (int i = 0; i < x.cols(); ++i) {
    place(i, x.col(i));
    for (int c = 0; c < 3; ++c) v_.data()[v_at(i) + c * lanes<T>] = static_cast<T>(v(c, i));
  }
}

template <class T>
void SheetBody<T>::get(int begin, int rows, int first, Points& x, Points& v) const {
  int i = first + begin * columns_;
  for (int row = begin; row < begin + rows; ++row) {
    const T *x_row = x_.data() + x_at(row * columns_), *v_row = v_.data() + v_at(row * columns_);
    for (int lane = 0; lane < lanes<T>; ++lane)
      for (int block = 0; block < blocks_ && lane * blocks_ + block < columns_; ++block, ++i) {
        const T *from = x_row + block * block_size<T> + lane, *speed = v_row + block * block_size<T> + lane;
        for (int c = 0; c < 3; ++c) x(c, i) = from[c * lanes<T>], v(c, i) = speed[c * lanes<T>];
      }
  }
}

template <class T>
Vec3 SheetBody<T>::position(int particle) const {
  const T* p = x_.data() + x_at(particle);
  return {p[0], p[lanes<T>], p[2 * lanes<T>]};
}

template <class T>
Vec3 SheetBody<T>::velocity(int particle) const {
  const T* p = v_.data() + v_at(particle);
  return {p[0], p[lanes<T>], p[2 * lanes<T>]};
}

template <class T>
Lines<T> SheetBody<T>::spread(const Eigen::ArrayXd& values) const {
  Lines<T> lines(values.size() == 1 ? lanes<T> : static_cast<size_t>(rows_) * blocks_ * lanes<T>);
  if (values.size() == 1) {
    std::fill_n(lines.data(), lanes<T>, static_cast<T>(values[0]));
    return lines;
  }
  for (int i = 0; i < values.size(); ++i) {
    const int row = i / columns_, column = i % columns_;
    lines.data()[(static_cast<long>(row) * blocks_ + column % blocks_) * lanes<T> + column / blocks_] =
        static_cast<T>(values[i]);
  }
  return lines;
}

template <class T>
void SheetBody<T>::get_forces(const Lines<T>& lines, Points& f) const {
  for (int i = 0; i < f.cols(); ++i)
    for (int c = 0; c < 3; ++c) f(c, i) = static_cast<double>(lines.data()[v_at(i) + c * lanes<T>]);
}

template class Lines<double>;
template class Lines<float>;
template class SheetBody<double>;
template class SheetBody<float>;

}  // namespace crosscheck::strip
