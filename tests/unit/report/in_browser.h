// A page opened from a file in a browser without a window, and what a script in it wrote down. Chromium is optional.
#pragma once

#include "mysim/base/json.h"
#include "mysim/base/process.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck::testing_tools {

class InBrowser : public InFolder {
 protected:
  /// Runs Chromium on the page with these flags besides the usual ones.
  ProgramResult browse(const std::filesystem::path& page, const std::vector<std::string>& flags) const {
    std::vector<std::string> call{"chromium",
                                  "--headless=new",
                                  "--no-sandbox",  // in a container as root there is none
                                  "--use-angle=swiftshader",
                                  "--enable-unsafe-swiftshader",
                                  "--disable-background-networking",
                                  "--disable-extensions",  // a quarter of what a start costs
                                  "--disable-component-update",
                                  "--disable-sync",
                                  "--no-first-run",
                                  "--force-prefers-reduced-motion",  // nothing moves unless it is told to
                                  "--user-data-dir=" + (folder_ / "profile").string(),
                                  "--window-size=900,800"};
    if (!real_time_) {
      call.emplace_back("--virtual-time-budget=60000");
      // pictures of a quarter of the pixels, on a page that is laid out as ever: most of the cost is their drawing
      call.emplace_back("--force-device-scale-factor=0.5");
    }
    call.insert(call.end(), flags.begin(), flags.end());
    call.push_back("file://" + page.string());
    return run_program(call, folder_);
  }

  /// Time passes as it does for a reader; the page says by its load event when it is done (real_time.js).
  bool real_time_ = false;

  /// These files of tests/unit as scripts, for the head of a page.
  static std::string scripts(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names)
      all += "<script>" + read(std::filesystem::path(CROSSCHECK_SOURCE) / "tests/unit/report" / name) + "</script>";
    return all;
  }

  /// What the page's self-test wrote into <script id="seen">.
  JsonField seen(const std::filesystem::path& page, std::vector<std::string> flags) const {
    flags.emplace_back("--dump-dom");
    const ProgramResult result = browse(page, flags);
    const std::string begin = "<script type=\"application/json\" id=\"seen\">";
    const size_t at = result.out.find(begin);
    if (at == std::string::npos) {
      ADD_FAILURE() << "the page did not come to its end: " << last_lines(result.err, 20);
      return JsonField::parse("{}", "what the page saw");
    }
    const size_t from = at + begin.size();
    return JsonField::parse(result.out.substr(from, result.out.find("</script>", from) - from), "what the page saw");
  }
};

}  // namespace crosscheck::testing_tools
