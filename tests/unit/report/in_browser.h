// Opens pages in a headless browser (Chromium, optional) and reads the results of scripts.
#pragma once

#include "mysim/base/json.h"
#include "mysim/base/process.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck::testing_tools {

class InBrowser : public InFolder {
 protected:
  /// Opens a page. `flags` are added to the usual command-line flags.
  ProgramResult browse(const std::filesystem::path& page, const std::vector<std::string>& flags) const {
    std::vector<std::string> call{"chromium",
                                  "--headless=new",
                                  "--no-sandbox",  // the root user of a container has no sandbox
                                  "--use-angle=swiftshader",
                                  "--enable-unsafe-swiftshader",
                                  "--disable-background-networking",
                                  "--disable-extensions",  // saves a quarter of the start-up time
                                  "--disable-component-update",
                                  "--disable-sync",
                                  "--no-first-run",
                                  "--force-prefers-reduced-motion",  // no animation unless requested
                                  "--user-data-dir=" + (folder_ / "profile").string(),
                                  "--window-size=900,800"};
    if (!real_time_) {
      call.emplace_back("--virtual-time-budget=60000");
      // a quarter of the pixels, with the same layout, because drawing takes most of the time
      call.emplace_back("--force-device-scale-factor=0.5");
    }
    call.insert(call.end(), flags.begin(), flags.end());
    call.push_back("file://" + page.string());
    return run_program(call, folder_);
  }

  /// True if the page runs in real time. Its load event then signals that the test has finished (real_time.js).
  bool real_time_ = false;

  /// Script elements that contain these files of tests/unit/report.
  static std::string scripts(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names)
      all += "<script>" + read(std::filesystem::path(CROSSCHECK_SOURCE) / "tests/unit/report" / name) + "</script>";
    return all;
  }

  /// Results of a self-test, from <script id="seen">.
  JsonField seen(const std::filesystem::path& page, std::vector<std::string> flags) const {
    flags.emplace_back("--dump-dom");
    const ProgramResult result = browse(page, flags);
    const std::string begin = "<script type=\"application/json\" id=\"seen\">";
    const size_t at = result.out.find(begin);
    if (at == std::string::npos) {
      ADD_FAILURE() << "the page did not finish: " << last_lines(result.err, 20);
      return JsonField::parse("{}", "what the page saw");
    }
    const size_t from = at + begin.size();
    return JsonField::parse(result.out.substr(from, result.out.find("</script>", from) - from), "what the page saw");
  }
};

}  // namespace crosscheck::testing_tools
