// The hand-out's `check`: runs the public tests on the student's functions, prints the grader's feedback, and writes
// mine.html. C++17, standard library only, no POSIX.
//   check             all tests
//   check 2 3.1       tests whose number begins with 2 or 3.1; the name of a part selects its tests
//   check --lang zh   in another language, if the hand-out has it
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

#include "calls.h"
#include "cases_file.h"
#include "judge.h"
#include "page.h"
#include "plot.h"
#include "seen.h"
#include "words.h"

#ifndef HANDOUT_FOLDER
#define HANDOUT_FOLDER "."
#endif

using namespace coursework;

namespace {

// Global, because a signal handler can access nothing else; prepared in advance, because a handler must not allocate.
const char* if_it_crashes = "";

void crashed(int) {
  std::fputs(if_it_crashes, stdout);
  std::fflush(stdout);
  std::_Exit(3);
}

/// Runs a call. `all` receives the raw answer, before features for the comparison are extracted.
Answer ask(const Case& what, Numbers* all = nullptr) {
  Answer answer;
  try {
    if (!coursework::answer(what.call, what.in, answer.got))
      throw std::runtime_error("check does not know the call " + what.call + "; are its files those of the hand-out?");
    if (all) *all = answer.got;
    const Found found = compared(what, answer.got);
    answer.how = found.got.empty() && !answer.got.empty() ? How::undecided : How::answered;
    answer.got = found.got, answer.of = found.of;
  } catch (const Unusable& error) {
    answer.how = How::unusable, answer.detail = error.what();
    for (const std::size_t number : error.numbers()) answer.counts.emplace_back("", static_cast<long>(number));
  } catch (const std::exception& error) {
    answer.how = How::threw, answer.detail = error.what();
  } catch (...) {
    answer.how = How::threw, answer.detail = "something that is no std::exception";
  }
  return answer;
}

struct Words {
  Texts common, own;
  static Words read(const std::string& folder, const std::string& language) {
    return {Texts::read(folder + "/check/common." + language + ".txt"),
            Texts::read(folder + "/check/texts." + language + ".txt")};
  }
  std::string title_of(const std::string& key) const { return own.has(key + ".title") ? own.of(key + ".title") : key; }
  PlotTexts of(const Case& c) const {
    return {common.of("legend.right"), common.of("legend.yours"),
            c.plot_x < 0 ? name_text(own, "row.", c.row) : column_text(own, c, c.plot_x),
            column_text(own, c, c.plot_y)};
  }
};

/// Plot of an ungraded motion that belongs to the test, or an empty string if the test or the student's code has none.
std::string motion(const std::string& test, const Words& words) {
  try {
    Case drawn;
    Numbers got;
    return motion_of(test, drawn, got) ? plot(drawn, got, words.of(drawn)) : "";
  } catch (...) {
    return "";
  }
}

/// Feedback on the small cases of a failed test. Stops at the second failing case of the same call.
std::string smallest(const PublicTest& test, const Words& words) {
  std::vector<Answer> answers;
  const Case* failed = nullptr;
  for (const Case& what : test.small) {
    answers.push_back(ask(what));
    if (failed && failed->call != what.call) continue;
    if (judge(what, answers.back()).right) continue;
    if (failed) break;
    failed = &what;
  }
  return smaller_text(words.common, words.own, test.small, answers);
}

/// Returns the numbers of a failing case and a diagnosis of them. For the diagnosis, also runs later cases with the
/// same call, up to the next failure.
std::string shown_beside(const PublicTest& test, const Case& what, const Answer& answer, const Words& words) {
  Answered others;
  for (std::size_t i = static_cast<std::size_t>(&what - test.cases.data()) + 1; i < test.cases.size(); ++i)
    if (answer.how == How::answered && test.cases[i].call == what.call && test.cases[i].in != what.in) {
      others.emplace_back(test.cases[i], ask(test.cases[i]));
      if (!judge(others.back().first, others.back().second).right) break;
    }
  std::string text = table_text(words.common, words.own, what, answer);
  const std::string seen = seen_text(words.common, words.own, what, answer, others);
  return text + (text.empty() || seen.empty() ? "" : "\n") + seen;
}

/// Runs the test's cases up to the first wrong one, and keeps a few plots, including that of the wrong case.
/// `failed_before`: the first failed test of the same function, if any; `told`: functions that already have feedback on
/// small cases.
ShownTest run(const PublicTest& test, const Words& words, const std::string& failed_before,
              std::set<std::string>& told) {
  ShownTest shown{words.title_of(test.part), test.id + " " + words.title_of(test.id), true, "", {}};
  for (const Case& what : test.cases) {
    Numbers came;
    const Answer answer = ask(what, &came);
    const Judged judged = judge(what, answer);
    shown.passed = judged.right;
    if (what.plot_y >= 0 && answer.how == How::answered && (shown.plots.size() < 2 || !judged.right))
      shown.plots.push_back(plot(what, answer.got, words.of(what)));
    if (judged.right) continue;
    shown.said = coursework::words(words.common, words.own, what, answer, judged);
    const std::size_t which = static_cast<std::size_t>(&what - test.cases.data()) + 1, of = test.cases.size();
    if (of > 1) shown.said = words.common.fill("which", std::to_string(which), std::to_string(of)) + " " + shown.said;
    if (const std::string given = given_text(words.common, words.own, what, judged); !given.empty())
      shown.said += "\n" + given;
    if (const std::string more = answer.how == How::answered ? asked_and_came(words.own, what, came) : "";
        !more.empty())
      shown.said += "\n" + more;
    std::string smaller;
    if (answer.how == How::answered && !test.small.empty() && told.insert(test.part + " " + test.small[0].call).second)
      smaller = smallest(test, words);
    if (smaller.empty() && failed_before.empty()) smaller = shown_beside(test, what, answer, words);
    if (!smaller.empty()) shown.said += "\n" + smaller;
    if (const std::string hint = hint_text(words.common, words.own, test.id, failed_before); !hint.empty())
      shown.said += "\n" + hint;
    if (!test.read.empty()) shown.said += "\n" + words.common.fill("read", test.read);
    break;
  }
  return shown;
}

std::string indented(const std::string& text) {
  std::string out = "      ";
  for (const char c : text) out += c == '\n' ? std::string("\n      ") : std::string(1, c);
  return out + "\n";
}

bool asked_for(const PublicTest& test, const std::vector<std::string>& which) {
  if (which.empty()) return true;
  for (const std::string& each : which)
    if (test.part == each || test.id.compare(0, each.size(), each) == 0) return true;
  return false;
}

int check(const std::string& language, const std::vector<std::string>& which) {
  // Windows may fail to open a path in UTF-8. In that case, uses the current folder instead
  const std::string cases = "/check/public_cases.txt";
  const std::string folder = std::ifstream(HANDOUT_FOLDER + cases) ? HANDOUT_FOLDER : ".";
  const std::string file = folder + cases, mine = folder + "/mine.html";
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  const PublicTests all = read_cases(in);
  const Words words = Words::read(folder, language);
  const std::string title = words.own.has("title") ? words.own.of("title") : all.title;

  const std::string crash =
      "\n" +
      indented(words.common.fill("how.crashed", words.common.of("crash.here")) + " " + words.common.of("crash.guess")) +
      indented(words.common.of("crash.rest"));
  if_it_crashes = crash.c_str();
  for (const int signal : {SIGSEGV, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, crashed);

  std::vector<ShownTest> shown;
  std::string part, total;
  std::map<std::string, std::string> failed;  // first failed test of each function
  std::set<std::string> told;
  int earned = 0, points = 0, passed = 0;
  for (const PublicTest& test : all.tests) {
    if (!asked_for(test, which) || test.cases.empty()) continue;
    if (test.part != part) std::cout << "\n" << words.title_of(part = test.part) << "\n";
    const std::string function = function_of(words.own, part, test.cases.front());
    // printed before the test runs, so that it is the last line if the test never returns
    std::cout << "  " << test.id << " " << words.title_of(test.id) << ": " << std::flush;
    shown.push_back(run(test, words, failed[function], told));
    if (!shown.back().passed && failed[function].empty()) failed[function] = test.id;
    const bool good = shown.back().passed;
    points += test.points, earned += good ? test.points : 0, passed += good;
    std::cout << words.common.of(good ? "passed" : "failed") << ", "
              << words.common.fill("points", std::to_string(good ? test.points : 0), std::to_string(test.points))
              << "\n"
              << (good ? std::string() : indented(shown.back().said)) << std::flush;
    // after the verdict, because the motion may run another part of the student's code, which may crash
    shown.back().plots.push_back(motion(test.id, words));
    total = words.common.fill("total", std::to_string(earned), std::to_string(points));
    std::ofstream(mine) << page(words.common.of("page.lang"), title, total, shown, words.common.of("passed"),
                                words.common.of("failed"));
  }
  if (shown.empty()) throw std::runtime_error("no public test has such a number or part");
  const std::string hidden = std::to_string(all.hidden);
  std::cout << "\n" << total << "\n";
  if (passed < static_cast<int>(shown.size()))
    std::cout << words.common.fill("public_now", std::to_string(passed), std::to_string(shown.size()), hidden) << "\n";
  else if (which.empty())
    std::cout << words.common.fill("public_done", hidden) << "\n";
  std::cout << mine << "\n";
  return passed == static_cast<int>(shown.size()) ? 0 : 1;
}

}  // namespace

void coursework::calling(const char*) {}  // no time limit in `check`: a student can interrupt it or use a debugger

int main(int count, char** values) {
  std::string language = "en";
  std::vector<std::string> which;
  for (int i = 1; i < count; ++i) {
    const std::string value = values[i];
    if (value == "--lang" && i + 1 < count)
      language = values[++i];
    else if (!value.empty() && value[0] != '-')
      which.push_back(value);
    else
      return std::cout << "check [--lang LANGUAGE] [NUMBERS OR PARTS...]\n", 2;
  }
  try {
    return check(language, which);
  } catch (const std::exception& error) {
    std::cout << "check: " << error.what() << "\n";
    return 2;
  }
}
