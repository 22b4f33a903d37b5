// What a study's tables and page become: CSV, JSON, HTML.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "apps/study/results.h"

namespace fathom::studies {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Row {
  std::string name;
  int count;
  double share;
  std::optional<double> measured;
  bool agrees;
};

const std::vector<Row> rows{{"one, two", 2, 0.125, 1.0 / 3, true}, {"a \"b\"", -7, 0.5, {}, false}};

Table table() {
  return {rows,
          {{Column("name").page("name"), &Row::name},
           {Column("count").json("list[]"), &Row::count},
           {Column("share").json("list[]").percent("share", ".1f"), &Row::share},
           {Column("measured", ".3g").page("measured", ".2f"), &Row::measured},
           {Column("agrees").json("member.agrees"), &Row::agrees},
           {Column("twice").csv_only(), [](const Row& r) { return 2 * r.count; }},
           {heading(""), [](const Row& r) { return r.agrees ? "<yes>" : "no & never"; }}}};
}

TEST(StudyTable, Csv) {
  EXPECT_EQ(csv_of(table()),
            "name,count,share,measured,agrees,twice\n"
            "\"one, two\",2,0.125,0.333,true,4\n"
            "\"a \"\"b\"\"\",-7,0.5,,false,-14\n");
}

TEST(StudyTable, Html) {
  EXPECT_EQ(html_of(table()),
            "<div class=\"wide\"><table>\n"
            "<tr><th>name</th><th>share</th><th>measured</th><th></th></tr>\n"
            "<tr><td>one, two</td><td>12.5 %</td><td>0.33</td><td>&lt;yes&gt;</td></tr>\n"
            "<tr><td>a \"b\"</td><td>50.0 %</td><td></td><td>no &amp; never</td></tr>\n"
            "</table></div>\n");
}

TEST(StudyTable, Json) {
  const Summary summary{{"near", Cell(1.0)},
                        {"far", Cell(std::numeric_limits<double>::infinity())},
                        {"eye", Cell(std::vector<double>{1, 2})},
                        {"counts.of all", Cell(3)},
                        {"rows", table()},
                        {"none", Table(std::vector<Row>{}, {{"name", &Row::name}})}};
  std::string json = json_of(summary);
  std::erase_if(json, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_EQ(json,
            "{\"near\":1.0,\"far\":null,\"eye\":[1.0,2.0],\"counts\":{\"ofall\":3},\"rows\":["
            "{\"name\":\"one,two\",\"list\":[2,0.125],\"measured\":0.3333333333333333,"
            "\"member\":{\"agrees\":true}},"
            "{\"name\":\"a\\\"b\\\"\",\"list\":[-7,0.5],\"measured\":null,"
            "\"member\":{\"agrees\":false}}],\"none\":[]}");
}

/// What has no place on an axis is not drawn, and no series or plot without a point.
TEST(StudyPlot, PointsWithoutAPlaceAreLeftOut) {
  const double infinity = std::numeric_limits<double>::infinity();
  Plot plot{.name = "p",
            .title = "t",
            .logarithmic_y = true,
            .series = {{"first", {{-1, 0.5}, {2, 0}, {3, -1}, {infinity, 1}, {4, infinity}}},
                       {"none", {{1, std::nan("")}}},
                       {"last", {{5, 0.25}}}}};
  const std::vector<StudyFile> files = draw(plot);
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].name, "p.gp");
  EXPECT_THAT(files[0].content,
              HasSubstr("$series0 << END\n-1 0.5\nEND\n$series1 << END\n5 0.25\nEND\n"));
  EXPECT_THAT(files[0].content, Not(HasSubstr("\"none\"")));
  plot.stretched_by_all = true;
  EXPECT_THAT(draw(plot)[0].content, HasSubstr("$series0 << END\n-1 0.5\n2 0\n3 -1\nEND\n"));
  plot.series.pop_back();
  plot.series.erase(plot.series.begin());
  EXPECT_TRUE(draw(plot).empty());
}

TEST(StudyPage, BlocksAndPlaceholders) {
  Page page(
      "# The {{what}} title\n\nA paragraph of\ntwo lines, {{what}} < all.\n\n## Next\n\n\n"
      "{{plot:drawn}} Caption of {{what}}\n\n{{plot:empty}} Not there\n\n{{picture:seen}} Seen: "
      "`run`\n\n"
      "{{text:words}} Words\n\n{{table:rows}}\n\n{{what}} first\n");
  page.add_value("what", "{{a}} & b");
  page.add_plot("drawn", true);
  page.add_plot("empty", false);
  page.add_picture("seen");
  page.add_picture("unseen");
  page.add_text("words", "a  b\n");
  page.add_table("rows", table());
  const std::string html = page.html();
  EXPECT_THAT(html, HasSubstr("<title>The {{a}} &amp; b title</title>"));
  EXPECT_EQ(
      html.substr(html.find("<body>\n")),
      "<body>\n<h1>The {{a}} &amp; b title</h1>\n"
      "<p>A paragraph of two lines, {{a}} &amp; b &lt; all.</p>\n<h2>Next</h2>\n"
      "<figure class=\"plot\"><a href=\"drawn.svg\">"
      "<img src=\"drawn.png\" alt=\"Caption of {{a}} &amp; "
      "b\"></a><figcaption>Caption of {{a}} &amp; b: <code>gnuplot drawn.gp</code></figcaption>"
      "</figure>\n"
      "<figure class=\"small\"><img src=\"seen.png\" alt=\"Seen\"><figcaption>Seen: "
      "<code>run</code>"
      "</figcaption></figure>\n"
      "<figure class=\"small\"><pre>a  b\n</pre><figcaption>Words</figcaption></figure>\n" +
          html_of(table()) + "<p>{{a}} &amp; b first</p>\n</body></html>\n");
}

// What the browser shows may not be broken at a hyphen, and what it copies has to be the command.
TEST(StudyPage, CommandsInTextsAndCaptions) {
  Page page(
      "# T\n\nSee `a --b | c > d` & more.\n\n{{picture:one}} one \"of\" them: `run -x`\n\n"
      "{{pictures:one,two}} two: `run`\n");
  page.add_picture("one", 40);
  page.add_picture("two");
  const std::string html = page.html();
  EXPECT_EQ(
      html.substr(html.find("<p>")),
      "<p>See <code>a <span>--b</span> | c &gt; d</code> &amp; more.</p>\n"
      "<figure class=\"small\"><img src=\"one.png\" alt=\"one &quot;of&quot; them\" "
      "width=\"40\"><figcaption>one \"of\" them: <code>run <span>-x</span></code></figcaption>"
      "</figure>\n"
      "<figure class=\"row\"><img src=\"one.png\" alt=\"two\" width=\"40\"> "
      "<img src=\"two.png\" alt=\"two\"><figcaption>two: <code>run</code></figcaption></figure>\n"
      "</body></html>\n");
}

TEST(StudyPage, WhatIsThereDecides) {
  const auto shown = [](bool drawn, bool with_value) {
    Page page(
        "# T\n\n{{if:plot:p}}\n\n{{plot:p}} P\n\n{{else}}\n\nNothing.\n\n{{end}}\n\nAlways.\n\n"
        "{{if:v}}\n\n{{v}} left.\n\n{{end}}\n\nLast.\n");
    page.add_plot("p", drawn);
    if (with_value) page.add_value("v", "7");
    return page.html();
  };
  EXPECT_THAT(shown(true, false),
              HasSubstr("<figcaption>P: <code>gnuplot p.gp</code></figcaption>"));
  EXPECT_EQ(html_plot("p", "One. Two."),
            "<figure class=\"plot\"><a href=\"p.svg\"><img src=\"p.png\" alt=\"One. Two.\"></a>"
            "<figcaption>One. Two. <code>gnuplot p.gp</code></figcaption></figure>\n");
  EXPECT_THAT(shown(true, false), Not(HasSubstr("Nothing.")));
  EXPECT_THAT(shown(false, true), HasSubstr("<p>Nothing.</p>\n<p>Always.</p>\n<p>7 left.</p>\n"));
  EXPECT_THAT(shown(false, false), HasSubstr("<p>Always.</p>\n<p>Last.</p>\n"));
}

TEST(StudyPage, PagesThatDoNotFitAreRefused) {
  Page page("# T\n\n{{value}}\n");
  EXPECT_THROW(page.add_plot("p", true), std::logic_error);
  EXPECT_THROW(page.add_table("t", table()), std::logic_error);
  EXPECT_THROW(static_cast<void>(page.html()), std::logic_error);
  page.add_value("value", "v");
  EXPECT_THAT(page.html(), HasSubstr("<p>v</p>"));
  EXPECT_THROW(static_cast<void>(Page("# T\n\n{{picture:none}} C: `run`\n").html()),
               std::logic_error);
  Page without_command("# T\n\n{{picture:p}} C\n");
  without_command.add_picture("p");
  EXPECT_THROW(static_cast<void>(without_command.html()), std::logic_error);
}

}  // namespace
}  // namespace fathom::studies
