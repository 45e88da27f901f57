// SPDX-License-Identifier: MIT
#include "figures/page.hpp"

#include "figures/folder.hpp"

#include <string_view>

namespace goffer::cli {
namespace {

// System colors, so that the page is as light or dark as the reader has it.
constexpr std::string_view style = R"(<style>
:root { color-scheme: light dark }
body { font: 1rem/1.5 system-ui, sans-serif; max-width: 60rem; margin: 0 auto; padding: 1rem }
h1 { font-size: 1.6rem; line-height: 1.2 }
h2 { font-size: 1.2rem; line-height: 1.3; margin: 2.5rem 0 0.5rem }
p { margin: 0.5rem 0; max-width: 45rem }
.pictures { display: grid; gap: 0.75rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 22rem), 1fr)); margin: 0.75rem 0 }
figure { margin: 0 }
figure img { width: 100%; height: auto; border-radius: 0.3rem }
figcaption { font-size: 0.9rem }
.wide { overflow-x: auto }
code { white-space: nowrap }
.chart { display: block; width: 100%; max-width: 40rem; height: auto }
table { border-collapse: collapse; font-size: 0.85rem; margin: 0.5rem 0 }
th, td { padding: 0.15rem 0.6rem; text-align: left; border-bottom: 1px solid GrayText; vertical-align: top }
.files, summary { font-size: 0.9rem }
</style>
)";

std::string link(const std::string& file) {
    return "<a href=\"" + file + "\">" + file + "</a>";
}

std::string pictures_of(const Figure& figure) {
    std::string text;
    for (const std::vector<FigurePicture>& row : figure.pictures) {
        text += "<div class=\"pictures\">\n";
        for (const FigurePicture& picture : row) {
            text += "<figure><a href=\"" + picture.file + "\"><img src=\"" + picture.file +
                    "\" alt=\"\"></a><figcaption>" + picture.caption + "</figcaption></figure>\n";
        }
        text += "</div>\n";
    }
    return text;
}

std::string chart_of(const Figure& figure, bool drawn) {
    if (figure.script.empty()) return {};
    if (!drawn)
        return "<p>The chart was not drawn (--no-charts); <code>gnuplot " + figure.name +
               ".gp</code> in this folder does.</p>\n";
    return "<img class=\"chart\" src=\"" + figure.name + ".svg\" alt=\"" + html_text(figure.title) + "\">\n";
}

std::string files_of(const Figure& figure) {
    std::string text = "<p class=\"files\">Data: " + link(figure.name + ".csv");
    if (figure.summary) text += ", " + link(figure.name + "_summary.csv");
    if (!figure.script.empty()) text += "; chart: " + link(figure.name + ".gp") + ", for gnuplot";
    return text + "</p>\n";
}

std::string section(const Figure& figure, bool charts) {
    std::string text = "<section id=\"" + figure.name + "\">\n<h2>" + html_text(figure.title) + "</h2>\n";
    for (const std::string& paragraph : figure.paragraphs) text += "<p>" + paragraph + "</p>\n";
    text += pictures_of(figure) + chart_of(figure, charts);
    text += "<details><summary>All numbers</summary>\n" + html(figure.table);
    if (figure.summary) text += html(*figure.summary);
    return text + "</details>\n" + files_of(figure) + "</section>\n";
}

std::string introduction(const PageFacts& facts) {
    std::string text =
        "<p>The results of Chen, Fang, Yang, Li, Chen: <i>Local Deformation Method for Soft Cylindrical "
        "Model</i>, "
        "Journal of System Simulation 27(6), 2015, made anew by goffer: figures 5 to 9 are numbered as in "
        "the paper, "
        "and others follow. Models: " +
        html_text(facts.models) +
        ". Every number in a text is one of the CSV file that is named below it.</p>\n";
    if (facts.quick)
        text +=
            "<p><strong>Made with --quick</strong>: fewer poses, runs and sizes than usual, so that times "
            "are rough.</p>\n";
    return text;
}

}  // namespace

std::string page_text(std::span<const Figure> figures, const PageFacts& facts) {
    std::string text =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" + std::string(page_mark) +
        "\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>goffer: "
        "figures</title>\n" +
        std::string(style) + "</head>\n<body>\n<h1>The paper&rsquo;s figures, by goffer</h1>\n" +
        introduction(facts);
    for (const Figure& figure : figures) text += section(figure, facts.charts);
    text += "<section id=\"machine\">\n<h2>The machine</h2>\n" + html(*facts.machine) +
            "<p class=\"files\">Data: " + link("machine.csv") + "</p>\n</section>\n";
    return text + "</body>\n</html>\n";
}

}  // namespace goffer::cli
