#pragma once

#include <string>
#include <vector>

namespace glovebench::reports {

// What the pages of a run and of a comparison share: one file each that needs no other.

/// A picture for a page.
struct Picture {
  std::string caption;
  std::string png;  ///< the file's bytes
};

/// The pictures under a heading; empty if there are none.
std::string picture_section(const std::string& title, const std::vector<Picture>& pictures);

/// A whole document with the project's style; `body` is HTML and follows the title as a heading.
std::string html_document(const std::string& title, const std::string& body);

}  // namespace glovebench::reports
