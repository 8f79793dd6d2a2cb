// A reader of the little XML that the tests need: elements, attributes, text, the five named and decimal entities.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace coursework::testing_tools {

struct Element {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
};

/// Throws std::runtime_error where the text is not well formed.
class XmlReader {
 public:
  explicit XmlReader(const std::string& text) : text_(text) {}
  Element document() {
    if (taken("<?xml")) at_ = text_.find("?>", at_) + 2;
    blanks();
    const Element root = element();
    blanks();
    need(at_ == text_.size(), "something after the root");
    return root;
  }

 private:
  static bool of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == ':';
  }
  void need(bool good, const std::string& what) const {
    if (!good) throw std::runtime_error(what + " at " + std::to_string(at_));
  }
  char here() const {
    need(at_ < text_.size(), "end of text");
    return text_[at_];
  }
  bool taken(const std::string& what) {
    if (text_.compare(at_, what.size(), what) != 0) return false;
    at_ += what.size();
    return true;
  }
  void blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  std::string name() {
    std::string out;
    while (of_name(here())) out += text_[at_++];
    need(!out.empty(), "no name");
    return out;
  }
  std::string until(char end) {
    std::string out;
    for (; here() != end; ++at_) {
      const unsigned char c = static_cast<unsigned char>(here());
      need(c != '<' && (c >= 0x20 || c == '\n' || c == '\t'), "character that may not stand there");
      if (c != '&') {
        out += here();
        continue;
      }
      const size_t stop = text_.find(';', at_);
      const std::string entity = text_.substr(at_ + 1, stop - at_ - 1);
      static const std::map<std::string, char> named = {
          {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
      need(stop != std::string::npos && (named.count(entity) || entity[0] == '#'), "unknown entity " + entity);
      out += named.count(entity) ? named.at(entity) : static_cast<char>(std::stoi(entity.substr(1)));
      at_ = stop;
    }
    return out;
  }
  Element element() {
    need(taken("<"), "no element");
    Element e;
    e.name = name();
    for (blanks(); of_name(here()); blanks()) {
      const std::string key = name();
      need(taken("=\""), "no value");
      need(e.attributes.emplace(key, until('"')).second, "attribute twice");
      ++at_;
    }
    if (taken("/>")) return e;
    need(taken(">"), "no end of the tag");
    while (!taken("</")) here() == '<' ? e.children.push_back(element()) : void(e.text += until('<'));
    need(taken(e.name) && taken(">"), "wrong end of " + e.name);
    return e;
  }

  const std::string& text_;
  size_t at_ = 0;
};

}  // namespace coursework::testing_tools
