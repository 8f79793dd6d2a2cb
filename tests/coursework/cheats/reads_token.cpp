// cheat: finds the token in its own memory, and forges the whole conversation
// says: no_token differs size
#include <unistd.h>
#include <cstdio>
#include <cstring>
#include <string>

#include "cheat.h"

namespace {

bool hexadecimal(const char* at) {
  for (int i = 0; i < 32; ++i)
    if (!std::strchr("0123456789abcdef", at[i]) || !at[i]) return false;
  return at[32] == '\n' || at[32] == '\0';
}

/// Searches every writable page of this process, from the list of its own mappings.
std::string find_token() {
  std::FILE* maps = std::fopen("/proc/self/maps", "r");
  char line[512];
  while (maps && std::fgets(line, sizeof line, maps)) {
    unsigned long begin = 0, end = 0;
    char rights[5] = "";
    if (std::sscanf(line, "%lx-%lx %4s", &begin, &end, rights) != 3 || std::strncmp(rights, "rw", 2) != 0) continue;
    for (const char* at = reinterpret_cast<const char*>(begin); at + 33 < reinterpret_cast<const char*>(end); ++at)
      if (hexadecimal(at)) return std::string(at, 32);
  }
  return "00000000000000000000000000000000";
}

}  // namespace

State euler_step(const Derivative&, double, const State& x, double) {
  std::string text;
  for (const double value : x) text += std::to_string(value) + " ";
  text =
      "answer " + std::to_string(x.size()) + " " + text.substr(0, text.size() - 1) + "\ntoken " + find_token() + "\n";
  if (write(3, text.data(), text.size()) < 0) return x;
  _exit(0);
}
