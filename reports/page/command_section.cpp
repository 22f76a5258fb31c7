#include "reports/command_tables.h"
#include "reports/page/section.h"
#include "reports/text.h"

namespace glovebench::reports {

Section command_section(const RunResult& result, const Timings& timings) {
  std::string html = "<p>" + escape_html(command_explanation()) + "</p>\n<h3>The stream</h3>\n";
  html += to_html(command_stream_table(result)) + "<h3>Interventions</h3>\n";
  const Table interventions = command_intervention_table(result);
  html += interventions.rows.empty() ? "<p>None.</p>\n" : to_html(interventions);
  html += "<h3>Against the truth's commands</h3>\n" + to_html(command_error_table(result)) + data_note("commands");
  if (const Table latency = command_latency_table(result, timings); !latency.rows.empty())
    html +=
        "<h3>From frame to command</h3>\n<p>Processor time from a frame of the device to its command: tracking, "
        "mapping, arm and guard, without transport. It differs from run to run.</p>\n" +
        to_html(latency);
  return {"commands", "Robot commands", html};
}

}  // namespace glovebench::reports
