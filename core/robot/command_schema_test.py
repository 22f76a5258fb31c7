"""The published schema accepts the commands that the program writes and nothing that differs from them.

Usage: command_schema_test.py EXAMPLE_PROGRAM. Needs the Debian package python3-jsonschema.
"""

import copy
import json
import pathlib
import subprocess
import sys
import unittest

import jsonschema

SCHEMA = json.loads((pathlib.Path(__file__).parent / "command.schema.json").read_text())


class CommandSchemaTest(unittest.TestCase):
    program = None

    @classmethod
    def setUpClass(cls):
        run = subprocess.run([cls.program], check=True, capture_output=True, text=True)
        cls.lines = [json.loads(line) for line in run.stdout.splitlines()]
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        cls.validator = jsonschema.Draft202012Validator(SCHEMA)

    def test_accepts_written_commands(self):
        self.assertEqual([line["state"] for line in self.lines], ["stopped", "following", "following", "holding", "stopped"])
        for line in self.lines:
            self.assertEqual([e.message for e in self.validator.iter_errors(line)], [])

    def test_refuses_changed_commands(self):
        changes = {
            "unknown key": lambda c: c.update(extra=1),
            "missing key": lambda c: c.pop("arm"),
            "fraction of a microsecond": lambda c: c.update(timestamp_us=0.5),
            "unknown status": lambda c: c.update(status="fine"),
            "unknown state": lambda c: c.update(state="flying"),
            "hold against the state": lambda c: c.update(hold=True),
            "nothing to follow": lambda c: c.update(base_hand=None),
            "unknown intervention": lambda c: c["interventions"].update(mood=1),
            "no intervention": lambda c: c["interventions"].update(stale=0),
            "missing motor": lambda c: c["actuators"]["target_deg"].pop("FFJ0"),
            "joint among the motors": lambda c: c["actuators"]["target_deg"].update(FFJ1=0),
            "beyond a limit": lambda c: c["joints"]["target_deg"].update(THJ4=70.1),
            "clamped twice": lambda c: c["joints"].update(clamped=["FFJ3", "FFJ3"]),
            "short position": lambda c: c["base_hand"]["position_m"].pop(),
            "text for an angle": lambda c: c["arm"]["target_deg"].update(S1="0"),
        }
        for name, change in changes.items():
            with self.subTest(name):
                command = copy.deepcopy(self.lines[2])
                change(command)
                self.assertFalse(self.validator.is_valid(command))


if __name__ == "__main__":
    CommandSchemaTest.program = sys.argv.pop(1)
    unittest.main()
