#include "report/figures/figure.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/names.h"
#include "mysim/base/text.h"
#include "reference/method.h"
#include "report/base/assets.h"
#include "report/base/gnuplot.h"
#include "report/figures/charts.h"

namespace crosscheck {
namespace {

struct Terminal {
  std::string set, ending;
};

std::vector<Terminal> terminals_of(const FigureInfo& figure, double height) {
  const double wide = figure.size.units(), dots = pixels_per_inch(figure.size) * figure.size.width / 2.54 / wide;
  std::string svg_name = figure.name;  // gnuplot accepts only letters, digits and _
  for (char& c : svg_name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return {{fmt::format("svg size {:.0f},{:.0f} dynamic font \"DejaVu Sans,12\" background \"#FFFFFF\" name {}", wide,
                       height, single_quoted(svg_name)),
           ".svg"},
          // scale font size 12 to the figure's font size; the factor 0.75 makes gnuplot's points as large as the page's
          {fmt::format("pdfcairo size {:.4g}cm,{:.4g}cm font \"DejaVu Sans,12\" fontscale {:.4g} linewidth {:.3g} "
                       "pointscale {:.3g}",
                       figure.size.width, figure.size.width * height / wide, 0.75 * figure.size.font / 12,
                       figure.size.font / 8.5, figure.size.font / 8.5),
           ".pdf"},
          {fmt::format("pngcairo size {:.0f},{:.0f} font \"DejaVu Sans,12\" fontscale {:.3g} linewidth {:.3g} "
                       "pointscale {:.3g}",
                       dots * wide, dots * height, 0.75 * dots, 0.85 * dots, 0.8 * dots),
           ".png"}};
}

}  // namespace

double pixels_per_inch(const FigureSize& size) { return std::min(300.0, 300 * 30 / size.width); }

std::string terminals(const FigureInfo& figure, double height, const std::string& plot) {
  std::string out;
  for (const Terminal& t : terminals_of(figure, height))
    out += fmt::format("set term {}\nset output {}\n{}", t.set, single_quoted(figure.name + t.ending),
                       out.empty() ? plot : "replot\n");
  return out + "set output\n";
}

std::string terminals_of_block(const FigureInfo& figure, double height, const std::string& block) {
  std::string out;
  for (const Terminal& t : terminals_of(figure, height))
    out += fmt::format("reset\nload \"style.gp\"\nset term {}\nset output {}\n{}set output\n", t.set,
                       single_quoted(figure.name + t.ending), block);
  return out;
}

namespace {

/// gnuplot's dash and point types.
struct CurveStyle {
  std::string_view colour, dash;
  int marker;
};

struct StyleOfMethod {
  std::string_view method;
  CurveStyle style;
};

// Other built-in methods get spare styles.
constexpr StyleOfMethod styles[] = {
    {"mysim/explicit-euler", {"#C0609A", "(10,3,2,3)", 15}},
    {"mysim/trapezoidal", {"#B87A00", "(2,2)", 11}},
    {"mysim/rk4", {"#009E73", "(6,3)", 9}},
    {"mysim/symplectic-euler", {"#1D6FB5", "(12,3,2,3)", 7}},
    {"mysim/leapfrog", {"#0B4F94", "1", 7}},
    {"mysim/suzuki4", {"#5B3FA0", "(12,3,3,3)", 15}},
    {"mysim/dopri5", {"#7F7F1F", "(3,2)", 13}},
    {"mysim/implicit-euler", {"#882255", "(18,3)", 11}},
    {"mysim/implicit-midpoint", {"#CC6677", "(8,2,2,2)", 9}},
    {"mysim/xpbd", {"#333333", "(5,4)", 5}},
    {"bullet/deformable-explicit", {"#803500", "(3,2)", 5}},
    {"bullet/deformable-implicit", {"#AA4499", "(20,3,4,3)", 11}},
    {"bullet/pbd", {"#B05200", "(8,4)", 13}},
    {"bullet32/deformable-explicit", {"#D08050", "(14,2,2,2)", 4}},
    {"bullet32/deformable-implicit", {"#B080C0", "(12,2,1,2)", 10}},
    {"bullet32/pbd", {"#B08050", "(4,2,1,2)", 6}},
    {"odeint/rk4", {"#0A7D5A", "(9,3)", 9}},
    {"odeint/dopri5", {"#2E9C86", "(3,4)", 9}},
    {"sundials/arkode", {"#8A7A1F", "(12,2,2,2)", 11}},
    {"sundials/cvode", {"#7A6A4A", "(4,2,2,2)", 13}},
};

// styles of external programs, and of methods without a row above
constexpr CurveStyle spare_styles[] = {{"#3F5F78", "(8,2,2,2,2,2)", 3},
                                       {"#AA3377", "(6,2,2,2)", 10},
                                       {"#117733", "(10,2,4,2)", 8},
                                       {"#44AA99", "(4,3,1,3)", 14},
                                       {"#6699CC", "(12,2,1,2)", 12}};

MethodStyle styled(const CurveStyle& style) {
  return {std::string(style.colour), std::string(style.dash), style.marker};
}

const StyleOfMethod* find_style(std::string_view method) {
  const auto* row = std::ranges::find(styles, method, &StyleOfMethod::method);
  return row == std::end(styles) ? nullptr : row;
}

bool lacks_style(const Method& method) { return method.family().is_engine() && !find_style(method.name); }

}  // namespace

MethodStyle spare_style(size_t place) {
  MethodStyle style = styled(spare_styles[place % std::size(spare_styles)]);
  style.dash = fmt::format("({},3,1,3,1,3)", 5 + 2 * place);
  return style;
}

MethodStyle style_of(const std::string& method) {
  if (method == sticky_method()) return {"#666666", "(3,3)", 8};
  if (const Method* known = builtin_method(method)) {
    if (const StyleOfMethod* row = find_style(known->name)) return styled(row->style);
    const auto before = builtin_methods().first(static_cast<size_t>(known - builtin_methods().data()));
    if (lacks_style(*known)) return spare_style(static_cast<size_t>(std::ranges::count_if(before, lacks_style)));
  }
  unsigned sum = 0;
  for (char c : method) sum = 31 * sum + static_cast<unsigned char>(c);
  // programs of the same colour usually differ in dash or marker
  constexpr size_t n = std::size(spare_styles);
  return styled({spare_styles[sum % n].colour, spare_styles[sum / n % n].dash, spare_styles[sum / n / n % n].marker});
}

void draw(const Drawing& figure, const Provenance& provenance, const std::filesystem::path& folder) {
  // gnuplot interprets files called "<NAME" and "|NAME" as commands
  if (!is_name(figure.name, longest_derived_name) || file_name_of(figure.name) != figure.name)
    throw InputError(fmt::format("figure {}: expected a name that can be a file's", shell_quote(figure.name)));
  // gnuplot writes gradually: a separate folder hides partial figures
  const std::filesystem::path work = folder / fmt::format(".{}.{}.part", figure.name, getpid());
  struct Remove {
    std::filesystem::path path;
    ~Remove() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  } remove{work};
  write_file(work / "style.gp", asset("figures/style.gp"));
  write_csv(figure.data, provenance, work);
  write_file(work / (figure.name + ".gp"), figure.script);
  const std::string what = "figure " + figure.name;
  const std::vector<std::string> forms{figure.name + ".svg", figure.name + ".pdf", figure.name + ".png"};
  print_warnings(run_gnuplot(figure.name + ".gp", work, forms, what), what);
  erase_pdf_date(work / (figure.name + ".pdf"));
  for (const auto& file : std::filesystem::directory_iterator(work))
    std::filesystem::rename(file.path(), folder / file.path().filename());
}

}  // namespace crosscheck
