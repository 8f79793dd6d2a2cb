// JUnit XML, as CI systems read it.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace crosscheck {

class JUnitReport {
 public:
  explicit JUnitReport(std::string suite) : suite_(std::move(suite)) {}
  /// `outcome`: failure, error or skipped; empty if the case passed.
  void add(const std::string& class_name, const std::string& name, const std::string& outcome = "",
           const std::string& message = "", const std::string& text = "");
  std::string xml() const;

 private:
  std::string suite_, body_;
  std::map<std::string, int> count_ = {{"failure", 0}, {"error", 0}, {"skipped", 0}};  // by outcome
  int cases_ = 0;
};

}  // namespace crosscheck
