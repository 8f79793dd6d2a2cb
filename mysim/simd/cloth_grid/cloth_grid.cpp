#include "mysim/simd/cloth_grid/cloth_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace crosscheck::simd {

COMPILED_FOR_EACH_INSTRUCTION_SET(Kernel<double> double_kernel(bool fast); Kernel<float> float_kernel(bool fast))

template <>
Kernel<double> kernel(InstructionSet isa, bool fast) {
  return SELECT_COMPILED(isa, double_kernel)(fast);
}

template <>
Kernel<float> kernel(InstructionSet isa, bool fast) {
  return SELECT_COMPILED(isa, float_kernel)(fast);
}

namespace {

std::vector<int> candidate_columns(const Springs& springs, int particles) {
  int farthest = 0;
  for (const Spring& s : springs.list) farthest = std::max(farthest, std::abs(s.b - s.a));
  std::vector<int> columns;
  if (farthest <= 2) columns.push_back(particles);  // a single row
  // the farthest spring leads two rows ahead, or one row ahead to the right, straight or to the left
  for (const int c : {farthest / 2, farthest - 1, farthest, farthest + 1})
    if (c > 1 && particles % c == 0 && std::find(columns.begin(), columns.end(), c) == columns.end())
      columns.push_back(c);
  return columns;
}

/// Direction of a spring from the earlier particle; nothing if it is not one of the six directions.
std::optional<int> direction_of(int a, int b, int columns) {
  const Direction to{b / columns - a / columns, b % columns - a % columns};
  for (int d = 0; d < directions; ++d)
    if (direction[d].down == to.down && direction[d].right == to.right) return d;
  return std::nullopt;
}

long spring_count(int rows, int columns, const Direction& d) {
  return std::max(0L, static_cast<long>(rows - d.down)) * std::max(0, columns - std::abs(d.right));
}

std::optional<GridTopology> grid_topology_with(const Springs& springs, int rows, int columns) {
  struct Collected {
    GridTopology::Stiffness family;
    std::vector<char> seen;  // indexed by the earlier end
    long count = 0;
  };
  std::array<Collected, directions> all;
  for (const Spring& s : springs.list) {
    const auto [a, b] = std::minmax(s.a, s.b);
    const auto d = direction_of(a, b, columns);
    if (!d) return std::nullopt;
    Collected& c = all[*d];
    if (c.count == 0) c.family = {s.k, s.rest}, c.seen.assign(static_cast<size_t>(rows) * columns, 0);
    if (s.k != c.family.k || s.rest != c.family.rest || c.seen[a]) return std::nullopt;
    c.seen[a] = 1;
    ++c.count;
  }
  GridTopology topology{rows, columns, {}};
  for (int d = 0; d < directions; ++d) {
    const Collected& c = all[d];
    if (c.count == 0) continue;
    if (c.count != spring_count(rows, columns, direction[d]) || !(c.family.rest > 0)) return std::nullopt;
    topology.families[d] = c.family;
  }
  return topology;
}

}  // namespace

std::optional<GridTopology> find_grid_topology(const Springs& springs, int particles) {
  if (springs.law != SpringLaw::hooke || springs.list.empty()) return std::nullopt;
  for ([[maybe_unused]] const Spring& s : springs.list)
    assert(0 <= s.a && s.a < particles && 0 <= s.b && s.b < particles);
  for (const int columns : candidate_columns(springs, particles))
    if (const auto topology = grid_topology_with(springs, particles / columns, columns)) {
      assert(topology->rows * topology->columns == particles);
      return topology;
    }
  return std::nullopt;
}

namespace {

template <class T>
constexpr int tile_size = 3 * lanes<T>;

}  // namespace

template <class T>
ClothGridMemory<T>::ClothGridMemory(const GridTopology& topology)
    : rows_(topology.rows), columns_(topology.columns), tiles_((topology.columns + lanes<T> - 1) / lanes<T>) {
  assert(rows_ > 0 && columns_ > 0);
  const size_t row = static_cast<size_t>(left_halo + tiles_ + right_halo) * tile_size<T>;
  x_ = AlignedBuffer<T>(row * rows_);
  v_ = AlignedBuffer<T>(static_cast<size_t>(tiles_) * tile_size<T> * rows_);
  force_ = AlignedBuffer<T>(3 * row);
  // places empty lanes far from the particles and from each other
  for (size_t i = 0; i < x_.size(); ++i) x_.data()[i] = T(1e6) + static_cast<T>(i % 4096) * T(17);
  grid_ = {rows_, tiles_, 0, 0, x_.data(), v_.data(), force_.data(), {}, {}, nullptr, nullptr, nullptr, 0};
  for (int d = 0; d < directions; ++d) {
    if (!topology.families[d]) continue;
    k_[d] = AlignedBuffer<T>(static_cast<size_t>(tiles_) * lanes<T>);
    assert(topology.families[d]->rest > 0);
    for (int c = 0; c < columns_; ++c)
      if (const int to = c + direction[d].right; to >= 0 && to < columns_)
        k_[d].data()[c % tiles_ * lanes<T> + c / tiles_] = static_cast<T>(topology.families[d]->k);
    grid_.k[d] = k_[d].data();
    grid_.rest[d] = static_cast<T>(topology.families[d]->rest);
  }
}

template <class T>
long ClothGridMemory<T>::x_at(int particle) const {
  assert(0 <= particle && particle < size());
  const int row = particle / columns_, column = particle % columns_;
  return (static_cast<long>(row) * (left_halo + tiles_ + right_halo) + left_halo + column % tiles_) * tile_size<T> +
         column / tiles_;
}

template <class T>
long ClothGridMemory<T>::v_at(int particle) const {
  assert(0 <= particle && particle < size());
  const int row = particle / columns_, column = particle % columns_;
  return (static_cast<long>(row) * tiles_ + column % tiles_) * tile_size<T> + column / tiles_;
}

template <class T>
void ClothGridMemory<T>::place(int particle, const Vec3& x) {
  const int column = particle % columns_, tile = column % tiles_;
  T *to = x_.data() + x_at(particle), *v = v_.data() + v_at(particle);
  for (int c = 0; c < 3; ++c) {
    to[c * lanes<T>] = static_cast<T>(x[c]), v[c * lanes<T>] = 0;
    if (tile < right_halo && column >= tiles_) to[tiles_ * tile_size<T> + c * lanes<T> - 1] = static_cast<T>(x[c]);
    if (tile == tiles_ - 1 && column + 1 < tiles_ * lanes<T> && column / tiles_ + 1 < lanes<T>)
      to[-tiles_ * tile_size<T> + c * lanes<T> + 1] = static_cast<T>(x[c]);
  }
}

template <class T>
void ClothGridMemory<T>::put(const Eigen::Ref<const Points>& x, const Eigen::Ref<const Points>& v) {
  assert(x.cols() == size() && v.cols() == size());
  for (int i = 0; i < x.cols(); ++i) {
    place(i, x.col(i));
    for (int c = 0; c < 3; ++c) v_.data()[v_at(i) + c * lanes<T>] = static_cast<T>(v(c, i));
  }
}

template <class T>
void ClothGridMemory<T>::get(int begin, int rows, int first, Points& x, Points& v) const {
  assert(begin >= 0 && begin + rows <= rows_);
  assert(first + begin * columns_ >= 0 && first + (begin + rows) * columns_ <= x.cols() && v.cols() == x.cols());
  int i = first + begin * columns_;
  for (int row = begin; row < begin + rows; ++row) {
    const T *x_row = x_.data() + x_at(row * columns_), *v_row = v_.data() + v_at(row * columns_);
    for (int lane = 0; lane < lanes<T>; ++lane)
      for (int tile = 0; tile < tiles_ && lane * tiles_ + tile < columns_; ++tile, ++i) {
        const T *from = x_row + tile * tile_size<T> + lane, *speed = v_row + tile * tile_size<T> + lane;
        for (int c = 0; c < 3; ++c) x(c, i) = from[c * lanes<T>], v(c, i) = speed[c * lanes<T>];
      }
  }
}

template <class T>
Vec3 ClothGridMemory<T>::position(int particle) const {
  const T* p = x_.data() + x_at(particle);
  return {p[0], p[lanes<T>], p[2 * lanes<T>]};
}

template <class T>
Vec3 ClothGridMemory<T>::velocity(int particle) const {
  const T* p = v_.data() + v_at(particle);
  return {p[0], p[lanes<T>], p[2 * lanes<T>]};
}

template <class T>
AlignedBuffer<T> ClothGridMemory<T>::spread(const Eigen::ArrayXd& values) const {
  assert(values.size() == 1 || values.size() == size());
  AlignedBuffer<T> buffer(values.size() == 1 ? lanes<T> : static_cast<size_t>(rows_) * tiles_ * lanes<T>);
  if (values.size() == 1) {
    std::fill_n(buffer.data(), lanes<T>, static_cast<T>(values[0]));
    return buffer;
  }
  for (int i = 0; i < values.size(); ++i) {
    const int row = i / columns_, column = i % columns_;
    buffer.data()[(static_cast<long>(row) * tiles_ + column % tiles_) * lanes<T> + column / tiles_] =
        static_cast<T>(values[i]);
  }
  return buffer;
}

template class ClothGridMemory<double>;
template class ClothGridMemory<float>;

namespace {

constexpr int halo_rows = 2;

/// Gives each slab at least twice as many rows as a neighbour copies from it.
int slab_count(int rows, int threads) { return std::clamp(rows / (2 * halo_rows), 1, std::max(threads, 1)); }

}  // namespace

template <class T>
Slabs<T>::Slabs(const GridTopology& topology, int threads)
    : columns_(topology.columns), pool_(slab_count(topology.rows, threads)) {
  const int count = pool_.size();
  for (int i = 0; i < count; ++i) {
    const int begin = static_cast<int>(static_cast<long>(topology.rows) * i / count),
              end = static_cast<int>(static_cast<long>(topology.rows) * (i + 1) / count);
    assert(count == 1 || end - begin >= 2 * halo_rows);
    const int leading_halo = i > 0 ? halo_rows : 0, trailing_halo = i + 1 < count ? halo_rows : 0;
    GridTopology part = topology;
    part.rows = leading_halo + end - begin + trailing_halo;
    slabs_.push_back(
        {i, ClothGridMemory<T>(part), (begin - leading_halo) * columns_, leading_halo, end - begin, {}, {}});
    Slab& slab = slabs_.back();
    slab.body.grid().leading_halo = leading_halo, slab.body.grid().trailing_halo = trailing_halo;
    if (count > 1)
      for (AlignedBuffer<T>& outgoing_halo : slab.outgoing_halo)
        outgoing_halo = AlignedBuffer<T>(2 * halo_rows * slab.body.row_length());
  }
}

template <class T>
void Slabs<T>::put(const Points& x, const Points& v) {
  assert(x.cols() == slabs_.back().first + slabs_.back().body.size() && v.cols() == x.cols());
  for (size_t i = 0; i < slabs_.size(); ++i) {
    slabs_[i].body.put(x.middleCols(slabs_[i].first, slabs_[i].body.size()),
                       v.middleCols(slabs_[i].first, slabs_[i].body.size()));
    send_halo(static_cast<int>(i), parity_);
  }
}

template <class T>
void Slabs<T>::get(Points& x, Points& v) const {
  for (const Slab& slab : slabs_) slab.body.get(slab.leading_halo, slab.own_rows, slab.first, x, v);
}

template <class T>
void Slabs<T>::receive_halo(int which) {
  assert(0 <= which && which < static_cast<int>(slabs_.size()));
  Slab& slab = slabs_[which];
  const long row = slab.body.row_length();
  const auto copy = [row](T* to, const T* from) { std::memcpy(to, from, halo_rows * row * sizeof(T)); };
  if (which > 0) copy(slab.body.row(0), slabs_[which - 1].outgoing_halo[parity_].data() + halo_rows * row);
  if (which + 1 < static_cast<int>(slabs_.size()))
    copy(slab.body.row(slab.leading_halo + slab.own_rows), slabs_[which + 1].outgoing_halo[parity_].data());
}

template <class T>
void Slabs<T>::send_halo(int which, int parity) {
  assert(0 <= which && which < static_cast<int>(slabs_.size()));
  if (slabs_.size() == 1) return;
  Slab& slab = slabs_[which];
  const long row = slab.body.row_length();
  T* to = slab.outgoing_halo[parity].data();
  std::memcpy(to, slab.body.row(slab.leading_halo), halo_rows * row * sizeof(T));
  std::memcpy(to + halo_rows * row, slab.body.row(slab.leading_halo + slab.own_rows - halo_rows),
              halo_rows * row * sizeof(T));
}

template class Slabs<double>;
template class Slabs<float>;

}  // namespace crosscheck::simd
