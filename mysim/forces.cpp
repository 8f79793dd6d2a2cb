#include "mysim/forces.h"

namespace crosscheck {
namespace {

void add_pairs(const std::vector<Tangent::Pair>& pairs, double factor, const Points& d, Points& out) {
  if (factor == 0) return;
  for (const Tangent::Pair& p : pairs) {
    const Vec3 difference = d.col(p.a) - d.col(p.b);
    const Vec3 f = factor * (p.across * difference + ((p.along - p.across) * p.n.dot(difference)) * p.n);
    out.col(p.a) += f;
    out.col(p.b) -= f;
  }
}

void add_blocks(const std::vector<Tangent::Pair>& pairs, double factor, Eigen::Matrix3Xd& blocks) {
  if (factor == 0) return;
  for (const Tangent::Pair& p : pairs) {
    const Eigen::Matrix3d block =
        factor * (p.across * Eigen::Matrix3d::Identity() + (p.along - p.across) * p.n * p.n.transpose());
    blocks.middleCols<3>(3 * p.a) += block;
    blocks.middleCols<3>(3 * p.b) += block;
  }
}

}  // namespace

void Tangent::add_product(double stiffness, double damping, const Points& d, Points& out) const {
  add_pairs(stiffness_, stiffness, d, out);
  add_pairs(damping_, damping, d, out);
}

void Tangent::add_diagonal(double stiffness, double damping, Eigen::Matrix3Xd& blocks) const {
  add_blocks(stiffness_, stiffness, blocks);
  add_blocks(damping_, damping, blocks);
}

}  // namespace crosscheck
