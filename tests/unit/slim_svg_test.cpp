// Figures lose bytes on their way into the page, and nothing that is drawn.
#include <gtest/gtest.h>

#include <regex>

#include "report/page/slim_svg.h"

namespace crosscheck {
namespace {

/// As gnuplot writes them: a frame with definitions, and what is inside.
std::string figure(const std::string& inside) {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"  standalone=\"no\"?>\n<svg \n viewBox=\"0 0 680 590\"\n "
         "xmlns=\"http://www.w3.org/2000/svg\"\n xmlns:xlink=\"http://www.w3.org/1999/xlink\"\n>\n\n<defs>\n\n"
         "\t<circle id='gpPt5' r='1'/>\n\t<use xlink:href='#gpPt5' id='gpPt6' fill='currentColor'/>\n"
         "\t<path id='gpPt7' d='M0,-1.33 L-1.33,0.67 L1.33,0.67 z'/>\n</defs>\n" +
         inside + "\n</svg>\n";
}

TEST(SlimSvg, PathsGoFromPointToPointToATenth) {
  const std::string slim =
      slim_svg(figure("<path stroke='rgb( 85,  85,  85)'  d='M76.02,226.65 L73.32,226.65 M10.00,0.50\n\t\tL10.00,-3.54 "
                      "L9.51,-4.00 '/>"));
  EXPECT_NE(slim.find("stroke='#555555' d='M76 226.7h-2.7M10 .5v-4l-.5-.5'"), std::string::npos) << slim;
}

TEST(SlimSvg, RoundingDoesNotAddUpAlongAPath) {
  std::string path = "M0.00,0.00";
  for (int i = 1; i <= 1000; ++i) path += " L" + std::to_string(i * 0.33) + "," + std::to_string(i * 0.27);
  const std::string slim = slim_svg(figure("<path d='" + path + "'/>"));
  const std::string d = slim.substr(slim.find("d='M") + 3);
  const std::regex number("-?[0-9]*\\.?[0-9]+");
  double x = 0, y = 0;
  const std::string moves = d.substr(0, d.find('\''));
  const std::regex step("([hlv])([^hlv]*)");
  for (std::sregex_iterator s(moves.begin(), moves.end(), step), end; s != end; ++s) {
    const std::string values = (*s)[2];
    std::sregex_iterator v(values.begin(), values.end(), number);
    if ((*s)[1] != "v") x += std::stod((v++)->str());
    if ((*s)[1] != "h") y += std::stod(v->str());
  }
  EXPECT_NEAR(x, 330, 0.05 + 1e-9);
  EXPECT_NEAR(y, 270, 0.05 + 1e-9);
}

TEST(SlimSvg, WhatItDoesNotKnowStays) {
  const std::string curve = "M1.00,2.00 C3.00,4.00 5.00,6.00 7.00,8.00";
  EXPECT_NE(slim_svg(figure("<path d='" + curve + "'/>")).find(curve), std::string::npos);
  const std::string odd = "<text>a  \"quoted\" name's part</text>";
  EXPECT_NE(slim_svg(figure(odd)).find("<text>a \"quoted\" name's part</text>"), std::string::npos);
  EXPECT_EQ(slim_svg("no picture"), "no picture");
}

TEST(SlimSvg, EmptyGroupsAndUnusedMarkersAreGoneUsedOnesStay) {
  const std::string slim = slim_svg(
      figure("<g fill=\"none\" color=\"black\">\n\t<g>\n</g>\n</g>\n<g><use xlink:href='#gpPt6' color='red'/></g>"));
  EXPECT_NE(slim.find("id='gpPt6'"), std::string::npos);
  EXPECT_NE(slim.find("id='gpPt5'"), std::string::npos) << "of which the used one is made";
  EXPECT_EQ(slim.find("gpPt7"), std::string::npos);
  EXPECT_EQ(slim.find("fill='none'"), std::string::npos);
  EXPECT_NE(slim.find("<g><use"), std::string::npos);
}

TEST(SlimSvg, AnAddressFitsIntoAnAttributeAndKeepsItsText) {
  const std::string address = svg_address(slim_svg(figure("<text fill=\"#333333\">5 % of \"a &lt; b\"</text>")));
  EXPECT_TRUE(address.starts_with("data:image/svg+xml"));
  EXPECT_EQ(address.find_first_of("\"#&\n"), std::string::npos) << address;
  EXPECT_NE(address.find("5 %25 of %22a %26lt; b%22"), std::string::npos) << address;
  EXPECT_EQ(address.find("//"), std::string::npos) << "the page needs no network: " << address;
}

}  // namespace
}  // namespace crosscheck
