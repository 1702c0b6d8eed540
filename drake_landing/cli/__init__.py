"""Command line: `drake-landing`.

Exit states are those of `fem.exit_status`. Heavy packages are imported by the commands
that need them.
"""

from drake_landing.cli.app import app as app
from drake_landing.cli.app import guarded as guarded
