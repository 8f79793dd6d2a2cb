#include "reference/protocol/trajectory_files.h"

#include <fmt/format.h>

#include <bit>
#include <cctype>
#include <fstream>
#include <optional>

#include "mysim/base/errors.h"

namespace crosscheck {

static_assert(std::endian::native == std::endian::little, "the data are written as they are in memory");

std::string npy_header(long frames, long particles) {
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}, 3), }}", frames, particles);
  // Magic (6), version (2), length (2), header and newline fill a multiple of 64 bytes. The header's words alone exceed
  // 64 bytes, so the total is 128, which leaves room for 57 digits.
  header.resize((10 + header.size() + 1 + 63) / 64 * 64 - 10 - 1, ' ');
  header += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(header.size() & 0xff);
  out += static_cast<char>(header.size() >> 8);
  return out + header;
}

std::string_view npy_data(const Points& frame) {
  // a 3 x n column-major frame is n x 3 in C order
  return {reinterpret_cast<const char*>(frame.data()), sizeof(double) * frame.size()};
}

std::string npy_bytes(const std::vector<Points>& frames) {
  std::string out = npy_header(static_cast<long>(frames.size()), frames.empty() ? 0 : frames.front().cols());
  for (const Points& x : frames) out += npy_data(x);
  return out;
}

namespace {

struct Header {
  std::string type;  // "<f8"
  bool fortran_order;
  std::vector<long> shape;
};

/// Text of the header's dictionary from the value of `key` to the end, without leading blanks.
std::optional<std::string> dictionary_value(const std::string& dictionary, const std::string& key) {
  size_t at = dictionary.find("'" + key + "'");
  if (at == std::string::npos || (at = dictionary.find(':', at)) == std::string::npos) return std::nullopt;
  at = dictionary.find_first_not_of(' ', at + 1);
  return at == std::string::npos ? std::nullopt : std::optional(dictionary.substr(at));
}

std::optional<Header> parse(const std::string& dictionary) {
  const auto type = dictionary_value(dictionary, "descr"), order = dictionary_value(dictionary, "fortran_order"),
             shape = dictionary_value(dictionary, "shape");
  if (!type || !order || !shape || (*type)[0] != '\'' || (*shape)[0] != '(') return std::nullopt;
  Header header{type->substr(1, type->find('\'', 1) - 1), order->starts_with("True"), {}};
  if (!header.fortran_order && !order->starts_with("False")) return std::nullopt;
  for (size_t i = 1; i < shape->size() && (*shape)[i] != ')';) {
    if (!std::isdigit(static_cast<unsigned char>((*shape)[i]))) {
      if ((*shape)[i] != ',' && (*shape)[i] != ' ') return std::nullopt;
      ++i;
      continue;
    }
    const size_t digits = shape->find_first_not_of("0123456789", i) - i;
    if (digits > 15) return std::nullopt;
    header.shape.push_back(std::stol(shape->substr(i, digits)));
    i += digits;
  }
  return header;
}

template <class T>
Points frame_from(std::ifstream& in, int particles) {
  Eigen::Matrix<T, 3, Eigen::Dynamic> x(3, particles);
  in.read(reinterpret_cast<char*>(x.data()), static_cast<std::streamsize>(sizeof(T)) * x.size());
  return x.template cast<double>();
}

std::string text_of(const std::vector<long>& shape) {
  std::string text;
  for (long length : shape) text += (text.empty() ? "" : ", ") + std::to_string(length);
  return "(" + text + (shape.size() == 1 ? ",)" : ")");
}

}  // namespace

std::vector<Points> read_npy(const std::filesystem::path& file, int min_frames, int max_frames, int particles) {
  auto fail = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", file.string(), what)); };
  std::ifstream in(file, std::ios::binary);
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (std::filesystem::is_directory(file, error)) fail("cannot be read; expected a .npy file, got a folder");
  if (!in || error) fail("cannot be read; expected a .npy file");
  unsigned char head[12] = {};
  in.read(reinterpret_cast<char*>(head), 10);
  if (!in || std::string(reinterpret_cast<char*>(head), 6) != "\x93NUMPY") fail("expected a .npy file");
  if ((head[6] != 1 && head[6] != 2) || head[7] != 0)
    fail(fmt::format("expected .npy format 1.0 or 2.0, got {}.{}", head[6], head[7]));
  size_t length = head[8] + 256u * head[9], begin = 10 + length;
  if (head[6] == 2) {
    in.read(reinterpret_cast<char*>(head + 10), 2);
    length += 65536u * head[10] + 16777216u * head[11];
    begin = 12 + length;
  }
  constexpr size_t longest = 65535;  // limit of format 1.0; shapes of three numbers need 128
  if (length > longest) fail(fmt::format("expected a header of at most {} bytes, got {}", longest, length));
  std::string dictionary(begin <= size ? length : 0, ' ');
  in.read(dictionary.data(), static_cast<std::streamsize>(dictionary.size()));
  const auto header = parse(dictionary);
  if (!in || !header) fail("expected a .npy header with descr, fortran_order and shape");
  if (header->type != "<f8" && header->type != "<f4")
    fail(fmt::format("expected float64 or float32, little endian ('<f8' or '<f4'), got '{}'", header->type));
  if (header->fortran_order) fail("expected C order, got Fortran order");

  const std::vector<long>& shape = header->shape;
  const std::string frames =
      min_frames == max_frames ? std::to_string(max_frames) : fmt::format("{} to {}", min_frames, max_frames);
  const std::string expected = fmt::format("shape ({0}, {1}, 3): {0} frames of {1} particles", frames, particles);
  if (shape.size() != 3 || shape[2] != 3) fail(fmt::format("expected {}, got {}", expected, text_of(shape)));
  if (shape[1] != particles)
    fail(fmt::format("expected {}, got {}: another number of particles", expected, text_of(shape)));
  if (shape[0] < min_frames || shape[0] > max_frames)
    fail(fmt::format("expected {}, got {}: another number of frames", expected, text_of(shape)));
  const size_t word = header->type == "<f8" ? 8 : 4;
  const size_t bytes = begin + word * 3 * static_cast<size_t>(shape[0]) * static_cast<size_t>(particles);
  if (size != bytes)
    fail(fmt::format("expected {} bytes for shape {}, got {}: {} than its header says", bytes, text_of(shape), size,
                     size < bytes ? "shorter" : "longer"));
  std::vector<Points> list;
  for (long i = 0; i < shape[0]; ++i)
    list.push_back(word == 8 ? frame_from<double>(in, particles) : frame_from<float>(in, particles));
  if (!in) fail("cannot be read to its end");
  return list;
}

Verdict TrajectoryWriter::observe(const State& state, bool sample) {
  if (!sample) return Verdict::ok;
  if (times_.empty()) {
    particles_ = state.x.cols();
    x_.emplace(folder_ / "trajectory.npy");
    if (state.v.cols() == particles_) v_.emplace(folder_ / "velocities.npy");
    for (auto* file : {&x_, &v_})
      if (*file) (*file)->append(npy_header(0, particles_));
  }
  times_.push_back(state.t);
  x_->append(npy_data(state.x));
  if (v_) v_->append(npy_data(state.v));
  return Verdict::ok;
}

void TrajectoryWriter::finish() {
  for (auto* file : {&x_, &v_})
    if (*file) {
      (*file)->rewrite_beginning(npy_header(static_cast<long>(times_.size()), particles_));
      (*file)->finish();
    }
}

std::vector<Points> read_positions(const std::filesystem::path& file, const Scene& scene, const Run& run,
                                   bool may_be_truncated) {
  const int frames = time_grid(run).samples + 1;
  std::vector<Points> x = read_npy(file, may_be_truncated ? 1 : frames, frames, scene.model.particles.size());
  // single precision stores the start to 1e-7 of its coordinates
  const double off = largest_column(x[0] - scene.start.x), scale = scene.size() + largest_column(scene.start.x);
  if (!(off <= 1e-6 * scale))
    throw InputError(fmt::format("{}: expected the scene's start as the first frame, got one that is {:.3g} m off",
                                 file.string(), off));
  return x;
}

void replay(const Frames& frames, const Scene& scene, const Run& run, Observer& observer, Outcome& out,
            int per_sample) {
  const TimeGrid steps = time_grid(run);
  const bool moving = !scene.model.first_order() && !frames.v.empty();
  for (size_t i = 0; i < frames.x.size(); ++i) {
    const double t = steps.time(static_cast<int>(i), 0);
    const bool sample = i % static_cast<size_t>(per_sample) == 0;
    const Verdict verdict = observer.observe({t, frames.x[i], moving ? frames.v[i] : Points(3, 0)}, sample);
    out.end = t;
    if (verdict == Verdict::ok) continue;
    out.verdict = verdict;
    out.reason = fmt::format("the run failed at t = {:.4g} s", t);
    return;
  }
}

}  // namespace crosscheck
