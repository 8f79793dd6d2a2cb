// What the engine has of a machine where there is none: no threads, no clock of its own, one instruction set, and no
// way to go on after something was thrown.
#include <cstddef>
#include <exception>
#include <typeinfo>

#include "mysim/base/this_process.h"
#include "mysim/simd/instruction_sets.h"
#include "mysim/simd/thread_pool.h"

/// Ends the call with a message; the page then makes a new instance.
__attribute__((import_module("lab"), import_name("fail"))) extern "C" void fail(const char* message);

/// Debian's libc++abi for WebAssembly has no exceptions: what is thrown ends the call. All that mysim throws derives
/// from std::exception, which comes first in it.
extern "C" void* __cxa_allocate_exception(std::size_t size) { return ::operator new(size); }
extern "C" [[noreturn]] void __cxa_throw(void* thrown, std::type_info*, void (*)(void*)) {
  fail(static_cast<std::exception*>(thrown)->what());
  __builtin_trap();
}

namespace crosscheck {

void CpuClock::start() {}
void CpuClock::stop() {}
double free_memory() { return 1e9; }

namespace simd {

InstructionSet active_instruction_set() { return InstructionSet::sse2; }

struct ThreadPool::Workers {};
ThreadPool::ThreadPool(int) {}
ThreadPool::~ThreadPool() = default;
int ThreadPool::size() const { return 1; }
void ThreadPool::all(const std::function<void(int)>& work) { work(0); }
double ThreadPool::seconds() const { return 0; }

}  // namespace simd
}  // namespace crosscheck
