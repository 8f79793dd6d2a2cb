#include "mysim/strip/crew.h"

#include "mysim/clock.h"

namespace crosscheck::strip {
namespace {

/// Returns when `number` has become another one: what it is then.
long next_after(const std::atomic<long>& number, long known) {
  constexpr int looks = 2000, polite_looks = 2000;  // some tens of microseconds; about a millisecond
  for (int i = 0; i < looks + polite_looks; ++i) {
    if (const long now = number.load(std::memory_order_acquire); now != known) return now;
    if (i < looks)
      __builtin_ia32_pause();
    else
      std::this_thread::yield();
  }
  number.wait(known, std::memory_order_acquire);
  return number.load(std::memory_order_acquire);
}

}  // namespace

Crew::Crew(int threads) : others_(threads - 1) {
  for (int i = 1; i < threads; ++i) others_[i - 1].thread = std::thread([this, i] { stand_by(i); });
}

Crew::~Crew() {
  if (others_.empty()) return;
  work_ = nullptr;
  begun_.fetch_add(1, std::memory_order_release);
  begun_.notify_all();
  for (Other& other : others_) other.thread.join();
}

void Crew::stand_by(int which) {
  for (long known = 0;;) {
    known = next_after(begun_, known);
    if (!work_) return;
    CpuClock clock;
    clock.start();
    (*work_)(which);
    clock.stop();
    others_[which - 1].seconds += clock.seconds();
    done_.fetch_add(1, std::memory_order_release);
    done_.notify_all();
  }
}

void Crew::all(const std::function<void(int)>& work) {
  if (!others_.empty()) {
    work_ = &work;
    begun_.fetch_add(1, std::memory_order_release);
    begun_.notify_all();
  }
  work(0);
  const long due = begun_.load(std::memory_order_relaxed) * static_cast<long>(others_.size());
  for (long done = done_.load(std::memory_order_acquire); done != due; done = next_after(done_, done)) {
  }
}

double Crew::seconds() const {
  double sum = 0;
  for (const Other& other : others_) sum += other.seconds;
  return sum;
}

}  // namespace crosscheck::strip
