#include "tests/coursework/grader/submission.h"

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"

namespace coursework {
namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string base_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

bool is_cpp(const std::string& path) {
  const std::string base = lower(base_name(path));
  const std::size_t dot = base.rfind('.');
  static constexpr const char* endings[] = {"h", "hpp", "hh", "hxx", "inl", "cpp", "cc", "cxx", "c++"};
  return dot != std::string::npos &&
         std::find(std::begin(endings), std::end(endings), base.substr(dot + 1)) != std::end(endings);
}

bool is_python(const std::string& path) { return lower(path).ends_with(".py"); }

bool is_source(const std::string& path) { return is_cpp(path) && lower(path.substr(path.rfind('.')))[1] == 'c'; }

int depth_of(const std::string& path) {
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t end; (end = path.find('/', begin)) != std::string::npos; begin = end + 1)
    depth += lower(path.substr(begin, end - begin)) != "src";
  return depth;
}

std::string FileMatcher::match(const std::string& path) const {
  // added by macOS for each file in an archive
  if (path.rfind("__MACOSX/", 0) == 0) return "";
  const std::string base = base_name(path);
  if (depth_of(path) <= 1 && lower(base) == choice_file) return choice_file;
  if (wanted_.empty()) return is_cpp(path) && !in_library(path) ? path : "";
  if (depth_of(path) > 1) return "";
  for (const std::string& name : wanted_)
    if (lower(name) == lower(base) || lower(name) == lower(without_copy_marks(base))) return name;
  return "";
}

bool FileMatcher::may_be_included(const std::string& path) const {
  static const std::set<std::string> others = {".c", ".inc", ".ipp", ".tpp", ".tcc", ".txx", ".def"};
  const bool source =
      wants_python() ? is_python(path) : is_cpp(path) || others.count(lower(fs::path(path).extension().string())) > 0;
  return !wanted_.empty() && path.size() <= longest_path && source && path.rfind("__MACOSX/", 0) != 0 &&
         !in_library(path);
}

std::string code_of(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::size_t end = i;
    if (text.compare(i, 2, "//") == 0)
      end = text.find('\n', i);
    else if (text.compare(i, 2, "/*") == 0)
      end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
    else if (text[i] == '"' || (text[i] == '\'' && (i == 0 || !std::isalnum(static_cast<unsigned char>(text[i - 1])))))
      for (end += 2; end < text.size() && text[end - 1] != text[i] && text[end - 1] != '\n'; ++end)
        end += text[end - 1] == '\\';
    end = std::min(end, text.size());
    for (std::size_t k = i; k < end; ++k)
      if (text[k] != '\n') text[k] = ' ';
    if (end > i) i = end - 1;
  }
  return text;
}

std::string with_includes(const std::string& text,
                          const std::function<std::string(const std::string& name, bool in_brackets)>& lead) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line); out += line + "\n") {
    std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') continue;
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
    at = line.find_first_of("\"<", at + 7);
    if (at == std::string::npos) continue;
    const bool in_brackets = line[at] == '<';
    const std::size_t end = line.find(in_brackets ? '>' : '"', at + 1);
    if (end == std::string::npos) continue;
    if (const std::string to = lead(line.substr(at + 1, end - at - 1), in_brackets); !to.empty())
      line.replace(at, end + 1 - at, to);
  }
  if (!out.empty() && text.back() != '\n') out.pop_back();
  return out;
}

namespace {

/// The source in UTF-8, with '/' instead of backslashes (which Visual Studio accepts) in the names of included files.
std::string plain_source(std::string text) {
  text = plain_utf8(std::move(text));
  if (text.find('\\') == std::string::npos) return text;
  return with_includes(text, [](std::string name, bool in_brackets) -> std::string {
    std::ranges::replace(name, '\\', '/');
    return in_brackets ? "<" + name + ">" : "\"" + name + "\"";
  });
}

}  // namespace

void FileMatcher::take(const std::string& path, std::string content) {
  const std::string name = match(path);
  if (!name.empty()) {
    taken_ += content.size();
    found_[name].push_back({path, {}, plain_source(std::move(content))});
  } else if (beside_.size() < most_program_files && (beside_size_ += content.size()) <= largest_program) {
    beside_[path] = plain_source(std::move(content));
  }
}

std::map<std::string, std::string> own_includes(const std::map<std::string, std::string>& files,
                                                const std::string& path, const std::string& content) {
  const auto normal = [](const std::string& folder, const std::string& name) {
    return (fs::path(folder) / name).lexically_normal().generic_string();
  };
  const auto folder_of = [](const std::string& file) { return fs::path(file).parent_path().generic_string(); };
  const auto includes_of = [](const std::string& text) {
    std::vector<std::string> names;
    with_includes(text, [&](const std::string& name, bool) { return names.push_back(name), ""; });
    return names;
  };
  std::map<std::string, std::string> found;
  std::vector<std::pair<std::string, const std::string*>> open = {{path, &content}};  // paths and contents
  const auto add = [&](const std::string& place, const std::string& file) {
    if (place != path && found.emplace(place, file).second) open.emplace_back(place, &files.at(file));
  };
  for (std::size_t i = 0; i < open.size(); ++i)
    for (const std::string& name : includes_of(*open[i].second)) {
      const std::string beside = normal(folder_of(open[i].first), name), here = normal(folder_of(path), name);
      if (name.empty() || fs::path(name).is_absolute()) continue;
      if (files.count(beside) || files.count(here)) {
        add(files.count(beside) ? beside : here, files.count(beside) ? beside : here);
        continue;
      }
      // a file in another folder, or with a name that differs in case, is included only if it is the only match
      const std::string end =
          "/" + lower(here.substr(here.rfind("../") == std::string::npos ? 0 : here.rfind("../") + 3));
      std::vector<std::string> alike;
      for (const auto& [file, text] : files)
        if (lower("/" + file).ends_with(end)) alike.push_back(file);
      if (alike.size() == 1 && crosscheck::is_path_inside(here)) add(here, alike.front());
    }
  return found;
}

std::optional<Remark> FileMatcher::too_large() const {
  if (!wanted_.empty()) return {};
  if (found_.size() - found_.count(choice_file) > most_program_files)
    return Remark{"program.entries", {std::to_string(most_program_files)}};
  if (taken_ > largest_program) return Remark{"program.size", {std::to_string(largest_program >> 20)}};
  return {};
}

std::vector<std::string> FileMatcher::paths() const {
  std::vector<std::string> paths;
  for (const auto& [name, all] : found_)
    for (const Found& one : all)
      if (name != choice_file) paths.push_back(one.path);
  return paths;
}

void FileMatcher::choose(Submission& submission) const {
  const auto file = found_.find(choice_file);
  if (file == found_.end()) return;
  const Found& found = file->second.front();
  try {
    if (!found.refused.empty() || found.content.size() > largest_choice)
      throw crosscheck::InputError(
          fmt::format("{}: expected a file of at most {} kB", choice_file, largest_choice >> 10));
    submission.choice = read_choice(found.content, paths(), roles_);
  } catch (const crosscheck::InputError& error) {
    submission.remarks.push_back({"choice.bad", {std::string(error.what()).substr(0, 400)}});
  }
}

void FileMatcher::into(Submission& submission) const {
  choose(submission);
  const StudentChoice& choice = submission.choice;
  if (wanted_.empty())
    for (const auto& [path, found] : found_) {
      if (path == choice_file || !choice.takes(path)) continue;
      if (found.front().refused.empty())
        submission.files[path] = found.front().content;
      else
        submission.remarks.push_back({found.front().refused, {path}});
    }
  const FullerCopy fuller(paths());
  std::map<std::string, std::string> beside;
  for (const auto& [path, content] : beside_)
    if (choice.takes(path)) beside[path] = content;
  for (const std::string& name : wanted_) {
    std::vector<Found> found;
    if (const auto all = found_.find(name); all != found_.end())
      std::copy_if(all->second.begin(), all->second.end(), std::back_inserter(found),
                   [&](const Found& one) { return choice.takes(one.path); });
    if (found.empty()) {
      submission.missing[name] = {"file.missing", {name}};
      continue;
    }
    // prefers files that are not backups, then files in fewer folders, then exact names over names that differ in case
    auto rank = [&](const Found& f) {
      return 8 * is_backup(f.path) + 2 * depth_of(f.path) +
             (lower(base_name(f.path)) == lower(name) && base_name(f.path) != name);
    };
    std::stable_sort(found.begin(), found.end(), [&](const Found& a, const Found& b) {
      return rank(a) != rank(b) ? rank(a) < rank(b) : fuller(a.path, b.path);
    });
    const Found& best = found.front();
    if (!best.refused.empty()) {
      submission.missing[name] = {best.refused, {name}};
    } else {
      submission.files[name] = best.content;
      if (best.path.size() <= longest_path) submission.places[name] = best.path;
      const auto add_included = [&](const std::string& path, const std::string& content) {
        for (const auto& [place, file] : own_includes(beside, path, content)) submission.files[file] = beside.at(file);
      };
      add_included(best.path, best.content);
      // Other sources in the same folder belong to the program, because the hand-out builds every source in its folder.
      // Python modules may also be in folders below.
      const std::string folder = best.path.substr(0, best.path.rfind('/') + 1);
      for (const auto& [path, content] : beside)
        if (path.starts_with(folder) && !is_backup(path) &&
            (wants_python() || (is_source(path) && path.find('/', folder.size()) == std::string::npos)))
          submission.files[path] = content, add_included(path, content);
    }
    for (const Found& other : found)
      if (other.path != best.path && other.content != best.content)
        submission.remarks.push_back({"file.left_out", {other.path, best.path}});
    if (submission.files.count(name) && base_name(best.path) != name)
      submission.remarks.push_back({"file.case", {name, base_name(best.path)}});
  }
}

// Folders are read through the file system. Archives are read with libarchive, a parser of untrusted zip and tar files
// that has been hardened for years.

namespace {

struct Refused {
  Remark why;
};

Remark too_many() { return {"archive.entries", {std::to_string(most_entries)}}; }
Remark too_much() { return {"archive.size", {std::to_string(largest_total >> 20)}}; }

/// nullopt if it is not (or no longer) a regular file, or is larger than a graded file may be. Never follows links or
/// waits for pipes.
std::optional<std::string> content_of(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return {};
  struct stat info {};
  std::optional<std::string> content;
  if (fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode)) {
    std::string text(largest_file + 1, '\0');
    std::size_t size = 0;
    for (ssize_t got; size < text.size() && (got = read(descriptor, &text[size], text.size() - size)) > 0;)
      size += static_cast<std::size_t>(got);
    text.resize(size);
    if (size <= largest_file) content = std::move(text);
  }
  close(descriptor);
  return content;
}

/// Reads the files of a folder. Returns the archives in the top folder and one below, which may contain the wanted
/// files.
std::vector<fs::path> read_folder(const fs::path& top, FileMatcher& matcher) {
  std::size_t entries = 0;
  std::vector<fs::path> archives;
  const auto options = fs::directory_options::skip_permission_denied;  // links to folders are not followed
  for (auto at = fs::recursive_directory_iterator(top, options); at != fs::recursive_directory_iterator(); ++at) {
    if (++entries > most_entries) throw Refused{too_many()};
    const fs::file_type type = at->symlink_status().type();
    // skips hidden folders: .git contains thousands of files
    if (at.depth() >= matcher.deepest() || at->path().filename().string()[0] == '.') at.disable_recursion_pending();
    if (type == fs::file_type::regular && at.depth() <= 1 && is_archive(at->path())) archives.push_back(at->path());
    const std::string path = at->path().lexically_relative(top).generic_string();
    if (type == fs::file_type::directory || !matcher.wants(path)) continue;
    if (type != fs::file_type::regular) {
      matcher.refuse(path, "file.link");
    } else if (auto content = content_of(at->path())) {
      matcher.take(path, std::move(*content));
    } else {
      matcher.refuse(path, "file.large");
    }
    if (const auto why = matcher.too_large()) throw Refused{*why};
  }
  return archives;
}

bool points_outside(const std::string& path) {
  if (path[0] == '/') return true;
  for (const fs::path& part : fs::path(path))
    if (part == "..") return true;
  return false;
}

struct Free {
  void operator()(archive* a) const { archive_read_free(a); }
};

/// Numbers of entries and of bytes unpacked so far, from an archive and the archives inside it.
struct Unpacked {
  std::size_t entries = 0, total = 0;
};

/// Unpacks the entry to its end, whatever size its header states; keeps slightly more than `most` bytes.
std::string unpack(archive* from, std::size_t& total, std::size_t most) {
  std::string content;
  std::string block(1u << 16, '\0');
  for (la_ssize_t got; (got = archive_read_data(from, block.data(), block.size())) != 0;) {
    if (got < 0) throw Refused{{"archive.unreadable", {"damaged, or locked with a password"}}};
    total += static_cast<std::size_t>(got);
    if (total > largest_total) throw Refused{too_much()};
    if (content.size() <= most) content.append(block.data(), static_cast<std::size_t>(got));
  }
  return content;
}

/// Verifies a gzip file by decompressing all of it with zlib, because libarchive ignores gzip's checksum
/// (consume_trailer() in its archive_read_support_filter_gzip.c skips it), and tar has no checksum of file contents.
void require_whole_gzip(const fs::path& file) {
  constexpr int window_of_gzip = 15 + 16;                                  // the largest window, with gzip's header
  constexpr std::size_t most = largest_total + most_entries * (4u << 10);  // including tar's headers and padding
  const Refused damaged{{"archive.unreadable", {"damaged: its checksum is wrong, or its end is missing"}}};
  std::ifstream in(file, std::ios::binary);
  std::string packed(1u << 16, '\0'), block(1u << 16, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, window_of_gzip) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  const auto refill = [&] {
    if (stream.avail_in > 0) return true;
    in.read(packed.data(), static_cast<std::streamsize>(packed.size()));
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(in.gcount());
    return stream.avail_in > 0;
  };
  std::size_t total = 0;
  for (bool more = true; more;) {  // one iteration per gzip member
    for (int status = Z_OK; status != Z_STREAM_END;) {
      if (!refill()) throw damaged;
      stream.next_out = reinterpret_cast<Bytef*>(block.data());
      stream.avail_out = static_cast<uInt>(block.size());
      status = inflate(&stream, Z_NO_FLUSH);
      if (status != Z_OK && status != Z_STREAM_END) throw damaged;
      total += block.size() - stream.avail_out;
      if (total > most) throw Refused{too_much()};
    }
    // tapes and some transfers append zeros
    while ((more = refill()) && *stream.next_in == 0) ++stream.next_in, --stream.avail_in;
    inflateReset(&stream);
  }
}

/// Path of an entry, with '/' and in UTF-8. Chinese systems write GBK, in which characters may contain the byte of a
/// backslash.
std::string path_of(archive_entry* entry) {
  const char* name = archive_entry_pathname_utf8(entry);
  if (!name) name = archive_entry_pathname(entry);
  std::string path = plain_utf8(name ? name : "?");   // a name in an unknown encoding matches no wanted file
  std::replace(path.begin(), path.end(), '\\', '/');  // some packers on Windows write backslashes
  while (path.rfind("./", 0) == 0) path.erase(0, 2);
  return path;
}

void read_archive(const fs::path& file, FileMatcher& matcher, Unpacked& sum, int depth = 1) {
  const std::unique_ptr<archive, Free> from(archive_read_new());
  // only common formats, and no filter that starts an external program
  for (const auto support :
       {archive_read_support_format_zip, archive_read_support_format_tar, archive_read_support_format_7zip,
        archive_read_support_format_rar, archive_read_support_format_rar5, archive_read_support_filter_gzip,
        archive_read_support_filter_bzip2, archive_read_support_filter_xz})
    support(from.get());
  const Refused unreadable{{"archive.unreadable", {"damaged, or of a kind that is not known"}}};
  if (archive_read_open_filename(from.get(), file.c_str(), 1u << 16) != ARCHIVE_OK) throw unreadable;
  archive_entry* entry = nullptr;
  std::size_t inner_count = 0;
  const crosscheck::TemporaryFolder inner("archive");
  for (int status; (status = archive_read_next_header(from.get(), &entry)) != ARCHIVE_EOF;) {
    if (status < ARCHIVE_WARN) throw unreadable;
    if (++sum.entries > most_entries) throw Refused{too_many()};
    std::string path = path_of(entry);
    if (path.empty()) continue;
    if (points_outside(path)) throw Refused{{"archive.path", {path.substr(0, 200)}}};
    path = fs::path(path).lexically_normal().string();
    const bool link = archive_entry_filetype(entry) != AE_IFREG || archive_entry_hardlink(entry);
    const bool folder = archive_entry_filetype(entry) == AE_IFDIR;
    const bool is_inner = !link && is_archive(path) && depth_of(path) <= 1 && path.rfind("__MACOSX/", 0) != 0;
    std::string content = unpack(from.get(), sum.total, is_inner ? largest_total : largest_file);
    if (is_inner && ++inner_count == 1) crosscheck::write_file(inner.path / "inner", content);
    if (folder || !crosscheck::is_path_inside(path) || !matcher.wants(path)) continue;
    if (link)
      matcher.refuse(path, "file.link");
    else if (content.size() > largest_file)
      matcher.refuse(path, "file.large");
    else
      matcher.take(path, std::move(content));
    if (const auto why = matcher.too_large()) throw Refused{*why};
  }
  if (archive_filter_code(from.get(), 0) == ARCHIVE_FILTER_GZIP) require_whole_gzip(file);
  if (!matcher.empty() || inner_count == 0) return;
  if (inner_count > 1) throw Refused{{"submission.archives", {std::to_string(inner_count)}}};
  if (depth == deepest_archive) throw Refused{{"archive.nested", {std::to_string(deepest_archive)}}};
  read_archive(inner.path / "inner", matcher, sum, depth + 1);
}

}  // namespace

bool is_archive(const fs::path& file) {
  static constexpr const char* endings[] = {".zip", ".tar", ".gz",   ".tgz", ".7z", ".rar",
                                            ".bz2", ".tbz", ".tbz2", ".txz", ".xz"};
  const std::string ending = lower(file.extension().string());
  return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

namespace {

void read_one(const fs::path& path, const std::string& name, FileMatcher& matcher) {
  Unpacked sum;
  // a link in a folder shared by students could submit another student's work
  if (fs::is_symlink(path)) throw Refused{{"submission.link", {}}};
  if (fs::is_directory(path)) {
    const std::vector<fs::path> archives = read_folder(path, matcher);
    if (!matcher.empty() || archives.empty()) return;
    if (archives.size() > 1) throw Refused{{"submission.archives", {std::to_string(archives.size())}}};
    read_archive(archives.front(), matcher, sum);
  } else if (matcher.wants(name)) {
    if (auto content = content_of(path))
      matcher.take(name, std::move(*content));
    else
      matcher.refuse(name, "file.large");
  } else {
    if (!fs::is_regular_file(path)) throw Refused{{"archive.unreadable", {"neither a file nor a folder"}}};
    read_archive(path, matcher, sum);
  }
}

Remark nothing_of(const std::vector<std::string>& wanted) {
  if (wanted.empty()) return {"submission.empty_program", {}};
  return {"submission.empty", {fmt::format("{}", fmt::join(wanted, ", "))}};
}

}  // namespace

Submission read_submission(const Handed& handed, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& roles) {
  Submission submission;
  submission.name = handed.name;
  FileMatcher matcher(wanted, roles);
  try {
    for (const auto& [path, name] : handed.files) {
      // other files, such as pictures and pages, are ignored if there are several
      if (handed.files.size() > 1 && !fs::is_directory(path) && !is_archive(name) && !matcher.wants(name)) continue;
      read_one(path, name, matcher);
    }
    if (matcher.empty()) throw Refused{nothing_of(wanted)};
  } catch (const Refused& refused) {
    submission.refused = true;
    submission.remarks.push_back(refused.why);
    for (const std::string& name : wanted) submission.missing[name] = {"file.missing", {name}};
    return submission;
  }
  matcher.into(submission);
  return submission;
}

Handed handed_at(const fs::path& path) {
  if (!fs::is_directory(path) && !fs::is_regular_file(path))
    throw crosscheck::InputError(fmt::format("{}: expected a folder or an archive (zip, 7z, rar, tar)", path.string()));
  const std::string name = (path.filename().empty() ? path.parent_path() : path).filename().string();
  return {name, {{fs::canonical(path), name}}};
}

Submission read_submission(const fs::path& path, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& roles) {
  return read_submission(handed_at(path), wanted, roles);
}

}  // namespace coursework
