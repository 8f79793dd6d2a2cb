// The one place where what was thrown becomes a message and an exit status.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <string_view>

namespace crosscheck {

/// What an exception says to people: one line that names the file or folder where one is concerned, without the words
/// of the library that threw.
std::string in_words(const std::exception_ptr& thrown);

/// Runs a program's work and returns its exit status. What it throws is told on standard error in one line that begins
/// with the program's name, and the status is 2: 1 is for answers that are no, which are returned, never thrown.
int run_and_tell(std::string_view program, const std::function<int()>& work);

}  // namespace crosscheck
