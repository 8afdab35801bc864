// Elements of a page. The page is HTML that is well-formed XML too: every element is closed, and
// texts of users are escaped (report/text.h) where they enter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gainsmith::page {

/// "<td class="n">content</td>"; `attributes` as they are written, `content` is markup.
std::string element(std::string_view tag, std::string_view content,
                    std::string_view attributes = {});

/// The same of a text, which is escaped.
std::string text_element(std::string_view tag, std::string_view text,
                         std::string_view attributes = {});

/// A text with its lines, as a file or a terminal shows it.
std::string preformatted(std::string_view text, std::string_view attributes = {});

/// A table of rows, markup, with the heads of its columns; each cell has its head too, for narrow
/// pages, where a cell is not below it. No cell contains a table.
std::string headed_table(const std::vector<std::string_view>& heads, std::string_view rows);

/// A heading and what is below it; nothing without content.
std::string section(std::string_view title, const std::string& content);

/// "1 run", "2 runs".
std::string count_of(unsigned long long number, const std::string& what);

}  // namespace gainsmith::page
