// Writes the report of an invented run, to try the schema and to look at the page: reports_example FOLDER

#include <cstdio>
#include <exception>

#include "reports/example_result.h"
#include "reports/report.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  try {
    using namespace glovebench::reports;
    write_report(argv[1], full_result(), {});
    write_report(std::string(argv[1]) + "/small", small_result(), {});
    std::fputs(figure4_table(full_result(), paper_numbers(), {}).c_str(), stdout);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
