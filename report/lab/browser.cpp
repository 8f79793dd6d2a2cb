// Replaces the system in a browser: there is one thread, one instruction set and no clock, and the page evaluates
// regular expressions. Exceptions end the instance.
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <typeinfo>

#include "mysim/base/errors.h"
#include "mysim/base/pattern.h"
#include "mysim/base/this_process.h"
#include "mysim/simd/instruction_sets.h"
#include "mysim/simd/thread_pool.h"

#define IMPORT(name) extern "C" __attribute__((import_module("page"), import_name(#name)))

/// Throws a JavaScript error, and therefore never returns.
IMPORT(fail) __attribute__((noreturn)) void page_fail(const char* kind, const char* message);
/// Returns 1 if the expression (ECMAScript grammar) matches a part of the text.
IMPORT(matches) int page_matches(const char* expression, const char* text);

// The runtime's `throw`. It may cast to std::exception, the first base of every exception of mysim and its libraries.
extern "C" {
void* __cxa_allocate_exception(std::size_t size) { return std::malloc(size); }
[[noreturn]] void __cxa_throw(void* thrown, std::type_info* type, void (*)(void*)) {
  const char* kind = *type == typeid(crosscheck::SolverFailure) ? "solver"
                     : *type == typeid(crosscheck::Unsupported) ? "unsupported"
                     : *type == typeid(crosscheck::InputError)  ? "input"
                                                                : "fault";
  page_fail(kind, static_cast<std::exception*>(thrown)->what());
}
}

namespace crosscheck {

void CpuClock::start() {}
void CpuClock::stop() {}
double free_memory() { return 2e9; }  // half of the 32-bit address space

struct Pattern::Compiled {
  std::string expression;
};
Pattern::Pattern(std::string_view expression) : compiled_(new Compiled{std::string(expression)}) {}
Pattern::~Pattern() = default;
bool Pattern::is_in(const std::string& text) const {
  return page_matches(compiled_->expression.c_str(), text.c_str()) != 0;
}

namespace simd {

std::string_view name_of(InstructionSet) { return "simd128"; }
InstructionSet active_instruction_set() { return InstructionSet::baseline; }

struct ThreadPool::Workers {};
ThreadPool::ThreadPool(int) {}
ThreadPool::~ThreadPool() = default;
int ThreadPool::size() const { return 1; }
void ThreadPool::all(const std::function<void(int)>& work) { work(0); }
double ThreadPool::seconds() const { return 0; }

}  // namespace simd
}  // namespace crosscheck
