#include <cfloat>
#include <cmath>
#include <stdexcept>

#include "tests/coursework/classic/oracles.h"
#include "tests/coursework/classic/probe/forces.h"

namespace coursework::classic {
namespace {

struct Malformed : std::runtime_error {
  Malformed() : std::runtime_error("no record of answers") {}
};

/// Replays each answer of the record once. Whatever the record contains, allocations are limited by its remaining size.
class Recorded : public probe::Asker {
 public:
  explicit Recorded(const Numbers& record) : record_(record) {}

  probe::State start() override { return changed({}, {}); }
  void store(const probe::State&) override {}
  probe::Some stored(const probe::Indices& which) override { return chosen(which); }
  probe::Some some(const probe::State&, const probe::Indices& which) override { return chosen(which); }

  probe::State changed(const probe::State&, const probe::State& known) override {
    const std::size_t size = count(), differ = count();
    if (differ > left() / 3 || size > known.size() + differ) throw Malformed();
    probe::State f = known;
    f.resize(size, probe::absent());
    for (std::size_t i = 0; i < differ; ++i) {
      const std::size_t which = known.empty() ? i : count();
      if (which >= size) throw Malformed();
      f[which] = vector();
    }
    return f;
  }
  void end(float drawn) override {
    if (next() != static_cast<double>(drawn) || left() != 0) throw Malformed();
  }

 private:
  std::size_t left() const { return record_.size() - at_; }
  double next() {
    if (left() == 0) throw Malformed();
    return record_[at_++];
  }
  std::size_t count() {
    const double value = next();
    // the first comparison also rejects nan
    if (!(value >= 0 && value <= 1e9) || value != std::floor(value)) throw Malformed();
    return static_cast<std::size_t>(value);
  }
  probe::Plain vector() {
    probe::Plain v;
    for (float& part : v.at) {
      const double value = next();
      if (std::isfinite(value) && std::abs(value) > static_cast<double>(FLT_MAX)) throw Malformed();
      part = static_cast<float>(value);
    }
    return v;
  }
  probe::Some chosen(const probe::Indices& which) {
    probe::Some some{count(), {}};
    for (const std::size_t i : which) some.entries.push_back(i < some.size ? vector() : probe::absent());
    return some;
  }

  const Numbers& record_;
  std::size_t at_ = 0;
};

}  // namespace

probe::Findings replay(const Case& what, const Numbers& answers) {
  probe::Findings found;
  try {
    Recorded recorded(answers);
    probe::Forces forces(recorded, static_cast<std::uint64_t>(what.in.at(1)));
    if (!forces.answer(what.call.substr(what.call.find('.') + 1), found)) return {};
  } catch (const std::runtime_error&) {
    return {};  // Malformed record, or Forces on a state without particles
  }
  return found;
}

}  // namespace coursework::classic
