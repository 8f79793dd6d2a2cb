// A sheet cut into bands of rows, one for each thread.
#pragma once

#include <deque>

#include "mysim/strip/crew.h"
#include "mysim/strip/sheet_body.h"

namespace crosscheck::strip {

/// Around its own rows a band has two of each neighbour: that is how far a spring reaches. Before a sweep it takes
/// their positions from where the neighbour left them after the last one; two such places, used in turns, let all bands
/// take and leave at the same time, so that they have to wait for each other once a sweep. Forces are summed in the
/// order of a single band: the same bits, however many there are.
template <class T>
class Bands {
 public:
  /// See Stride: of each particle, or one line for all.
  struct Factors {
    Lines<T> lose, push, span;
  };
  struct Band {
    int which;
    SheetBody<T> body;
    int first;                     // particle that is 0 here
    int lead, own;                 // rows
    Lines<T> left[2];              // for the neighbours: two rows at the beginning of its own, two at the end
    std::vector<Factors> factors;  // of each kick
    /// The particle here that is i in the scene; -1 where it is none of this band's rows.
    int here(int i) const { return i >= first && i - first < body.size() ? i - first : -1; }
  };

  /// As many bands as threads, or fewer where rows are few.
  Bands(const Weave& weave, int threads);

  void put(const Points& x, const Points& v);
  void get(Points& x, Points& v) const;
  /// sweep(band) for each, on its own thread, with its neighbours' rows where they are now.
  template <class Sweep>
  void sweep(Sweep one) {
    const std::function<void(int)> work = [&](int which) {
      take(which);
      one(bands_[which]);
      leave(which, 1 - turn_);
    };
    crew_.all(work);
    turn_ = 1 - turn_;
  }
  std::deque<Band>& all() { return bands_; }
  double other_seconds() const { return crew_.seconds(); }

 private:
  void take(int which);
  void leave(int which, int turn);

  int columns_;
  std::deque<Band> bands_;
  Crew crew_;
  int turn_ = 0;
};

}  // namespace crosscheck::strip
