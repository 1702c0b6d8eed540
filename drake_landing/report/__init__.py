"""The report: one self-contained HTML page per run."""

from drake_landing.report.page import write_report

__all__ = ["write_report"]
