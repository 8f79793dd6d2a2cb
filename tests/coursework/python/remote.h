// Calls the student's functions in a Python interpreter, over descriptors 4 (from the interpreter) and 5 (to it). The
// interpreter runs loader.py. Messages are lines of words, in both directions; calls may be nested:
//   call NAME VALUE...                   to the interpreter: a function of the student's; from the interpreter: an
//                                        official function, or f0, f1, ... (functions that were arguments)
//   return VALUE [changed I VALUE]...    the value, and arguments that the function has overwritten, as NumPy allows
//   threw TEXT                           only from the interpreter: an exception, with file and line
//   refused                              only to the interpreter: f does not accept these arguments
// VALUE is an array: a DIMENSIONS SIZE... NUMBER...; an object: o FIELDS (NAME VALUE)...; or a function: f ID.
// C++17, standard library and POSIX only.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "calls.h"

namespace coursework {

/// Reads a line word by word. A missing word is returned as an empty string, a missing number as 0.
class Words {
 public:
  explicit Words(const std::string& line) : at_(line.c_str()) {}
  std::string next() {
    while (*at_ == ' ') ++at_;
    const char* begin = at_;
    while (*at_ && *at_ != ' ') ++at_;
    return {begin, at_};
  }
  std::size_t count() { return std::strtoul(next().c_str(), nullptr, 10); }
  double number() { return std::strtod(next().c_str(), nullptr); }
  std::string rest() const { return at_; }
  bool done() const { return *at_ == '\0'; }

 private:
  const char* at_;
};

template <class T, class = void>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<T, std::void_t<decltype(T::x), decltype(T::z)>> = true;
/// Number of dimensions of the NumPy array for a number, a vector or a list of either; -1 for all other types.
template <class T>
constexpr int dimensions = std::is_same_v<T, double> ? 0
                           : is_vector<T>            ? 1
                                                     : -1;
template <class T>
constexpr int dimensions<std::vector<T>> = dimensions<T> + 1;

template <class T>
void append(Numbers& numbers, const T& value) {
  if constexpr (std::is_same_v<T, double>) {
    numbers.push_back(value);
  } else if constexpr (is_vector<T>) {
    numbers.insert(numbers.end(), {value.x, value.y, value.z});
  } else {
    for (const auto& each : value) append(numbers, each);
  }
}

template <class T>
void write_array(std::string& line, const T& value) {
  Numbers numbers;
  append(numbers, value);
  line += " a " + std::to_string(dimensions<T>);
  if constexpr (dimensions < T >> 0 && !is_vector<T>) line += " " + std::to_string(value.size());
  if constexpr (is_vector<T> || dimensions<T> == 2) line += " 3";
  char text[40];
  for (const double number : numbers) line.append(text, std::snprintf(text, sizeof text, " %a", number));
}

/// Reads an array. Throws Unusable if it has another shape.
template <class T>
T read_array(Words& words) {
  if (words.next() != "a") throw Unusable("arguments");
  std::vector<std::size_t> shape(std::min<std::size_t>(words.count(), 32));
  for (std::size_t& size : shape) size = words.count();
  constexpr std::size_t wanted = dimensions<T>;
  if (shape.size() != wanted) throw Unusable("dimensions", {shape.size(), wanted});
  if constexpr (is_vector<T> || wanted == 2)
    if (shape.back() != 3) throw Unusable("components", {shape.back()});
  T value{};
  const auto read_vector = [&](auto& v) { v.x = words.number(), v.y = words.number(), v.z = words.number(); };
  if constexpr (wanted == 0) {
    value = words.number();
  } else if constexpr (is_vector<T>) {
    read_vector(value);
  } else {
    for (std::size_t left = shape[0]; left > 0 && !words.done(); --left) {
      auto& added = value.emplace_back();
      if constexpr (wanted == 1)
        added = words.number();
      else
        read_vector(added);
    }
  }
  return value;
}

class Python {
 public:
  Python();
  Python(const Python&) = delete;

  /// Calls a function of the student's; throws std::runtime_error with the place and text of a Python exception.
  template <class R, class... A>
  R call(const std::string& function, const A&... values) {
    const std::size_t lent = lent_;
    std::string line = "call " + function;
    (put(line, values), ...);
    send(line);
    for (;;) {
      const std::string reply = receive();
      Words words(reply);
      const std::string kind = words.next();
      if (kind == "call") {
        send(served(words));
        continue;
      }
      while (lent_ > lent) functions_.erase("f" + std::to_string(--lent_));
      const std::exception_ptr failure = std::exchange(failure_, nullptr);
      if (kind != "return" && failure) std::rethrow_exception(failure);
      if (kind != "return") throw std::runtime_error(words.rest().substr(!words.done()));
      const R result = read_array<R>(words);
      while (words.next() == "changed") {
        const std::size_t which = words.count();
        std::size_t i = 0;
        ((i++ == which ? overwrite(values, words) : void()), ...);
      }
      return result;
    }
  }

  /// Makes an official function available to the student.
  template <class R, class... A>
  void offer(const std::string& name, R (*function)(A...)) {
    functions_[name] = answering<R, A...>(function);
  }

 private:
  using Function = std::function<std::string(Words&)>;

  template <class R, class... A, class F>
  Function answering(F function) {
    return [this, function](Words& words) {
      const std::tuple<std::decay_t<A>...> values{take(words, static_cast<std::decay_t<A>*>(nullptr))...};
      std::string line = "return";
      write_array(line, std::apply(function, values));
      return line;
    };
  }

  template <class T>
  T take(Words& words, T*) {
    if constexpr (dimensions<T> >= 0) {
      return read_array<T>(words);
    } else {  // an object: its fields in the order in which they were sent
      T object{};
      if (words.next() != "o") throw Unusable("arguments");
      words.count();
      each_field(object, [&](const char* name, auto& field) {
        if (words.next() != name) throw Unusable("arguments");
        field = read_array<std::decay_t<decltype(field)>>(words);
      });
      return object;
    }
  }
  template <class R, class... A>
  std::function<R(A...)> take(Words& words, std::function<R(A...)>*) {
    if (words.next() != "f") throw Unusable("arguments");
    return [this, name = "f" + words.next()](A... values) { return call<R>(name, values...); };
  }

  template <class R, class... A>
  void put(std::string& line, const std::function<R(A...)>& function) {
    line += " f " + std::to_string(lent_);
    functions_["f" + std::to_string(lent_++)] = answering<R, A...>(function);
  }
  template <class T>
  void put(std::string& line, const T& value) {
    if constexpr (dimensions<T> >= 0) {
      write_array(line, value);
    } else {  // an object: the assignment's python.cpp names the fields of its types
      T object = value;
      std::string fields;
      int count = 0;
      each_field(object, [&](const char* name, const auto& field) {
        write_array(fields += std::string(" ") + name, field), ++count;
      });
      line += " o " + std::to_string(count) + fields;
    }
  }

  /// Overwrites an argument, because arrays are never const in Python. Assigns in place, so that the elements of a list
  /// do not move.
  template <class T>
  static void overwrite(const T& value, Words& words) {
    if constexpr (dimensions < T >> 0) {
      const T now = read_array<T>(words);
      if constexpr (is_vector<T>)
        const_cast<T&>(value) = now;
      else if (now.size() == value.size())
        std::copy(now.begin(), now.end(), const_cast<T&>(value).begin());
    }
  }

  std::string served(Words& words) {
    try {
      const auto function = functions_.find(words.next());
      if (function == functions_.end()) throw Unusable("arguments");
      return Function(function->second)(words);
    } catch (...) {
      failure_ = std::current_exception();  // reported unless the student's code handles the refusal
      return "refused";
    }
  }

  void send(const std::string& line) {
    const std::string all = line + "\n";
    for (std::size_t done = 0; done < all.size();) {
      const ssize_t count = write(5, all.data() + done, all.size() - done);
      if (count <= 0) end();
      done += static_cast<std::size_t>(count);
    }
  }

  std::string receive() {
    std::size_t at = 0;
    for (char block[65536]; (at = buffer_.find('\n', at)) == std::string::npos;) {
      at = buffer_.size();
      const ssize_t count = read(4, block, sizeof block);
      if (count <= 0) end();
      buffer_.append(block, static_cast<std::size_t>(count));
    }
    const std::string line = buffer_.substr(0, at);
    buffer_.erase(0, at + 1);
    return line;
  }

  /// Called when the interpreter has ended: ends like a program that is too slow, and reports the counts of calls.
  [[noreturn]] static void end() {
    std::raise(SIGXCPU);
    _exit(3);
  }

  std::map<std::string, Function> functions_;  // functions that the interpreter may call
  std::size_t lent_ = 0;                       // number of functions passed as arguments of the current calls
  std::exception_ptr failure_;
  std::string buffer_;
};

/// Offers the official functions of earlier parts. Defined in the assignment's python.cpp.
void offer_official(Python& python);

inline Python::Python() {
  std::signal(SIGPIPE, SIG_IGN);
  offer_official(*this);
}

inline Python& interpreter() {
  static Python python;
  return python;
}

/// Calls a function of the student's in the interpreter of this program.
template <class R, class... A>
R in_python(const char* function, const A&... values) {
  return interpreter().call<R>(function, values...);
}

}  // namespace coursework
