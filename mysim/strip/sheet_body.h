// The memory of a sheet: particles of a scene laid out in lanes, and back.
#pragma once

#include <memory>

#include "mysim/particles.h"
#include "mysim/strip/recognise.h"
#include "mysim/types.h"

namespace crosscheck::strip {

/// Numbers that begin at a cache line, with a cache line to spare on either side.
template <class T>
class Lines {
 public:
  Lines() = default;
  explicit Lines(size_t count);
  T* data() { return data_; }
  const T* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(T* memory) const;
  };
  std::unique_ptr<T, Free> memory_;
  T* data_ = nullptr;
  size_t size_ = 0;
};

/// Whether a grid is wide enough for its springs to reach across lanes in one direction only.
template <class T>
bool fits(const Weave& weave) {
  return (weave.columns + lanes<T> - 1) / lanes<T> >= 3;
}

template <class T>
class SheetBody {
 public:
  explicit SheetBody(const Weave& weave);

  Sheet<T>& sheet() { return sheet_; }
  int size() const { return rows_ * columns_; }  // particles
  /// A row of positions, with the copies beside it: so many numbers.
  T* row(int which) { return x_.data() + which * row_length(); }
  long row_length() const { return static_cast<long>(before + blocks_ + after) * 3 * lanes<T>; }

  /// All particles, and the copies beside the rows.
  void put(const Eigen::Ref<const Points>& x, const Eigen::Ref<const Points>& v);
  /// Some rows; the column of x and v of particle i is first + i.
  void get(int row, int rows, int first, Points& x, Points& v) const;
  /// One particle, with the copies of it: v is set to 0.
  void place(int particle, const Vec3& x);
  Vec3 position(int particle) const;
  Vec3 velocity(int particle) const;
  /// Numbers of each particle (or of all: one number), into lines of their own laid out as the kernel reads them; lanes
  /// without a particle hold 0 where each has its own.
  Lines<T> spread(const Eigen::ArrayXd& values) const;
  Lines<T> memory_of_forces() const { return Lines<T>(v_.size()); }
  void get_forces(const Lines<T>& lines, Points& f) const;

  /// The particle in a lane of a block; -1 where there is none.
  int particle(int row, int block, int lane) const {
    const int column = lane * blocks_ + block;
    return column < columns_ ? row * columns_ + column : -1;
  }

 private:
  long x_at(int particle) const;  // of its first coordinate; the others are a line further
  long v_at(int particle) const;

  int rows_, columns_, blocks_;
  Lines<T> x_, v_, force_;
  Lines<T> k_[directions];
  Sheet<T> sheet_{};
};

}  // namespace crosscheck::strip
