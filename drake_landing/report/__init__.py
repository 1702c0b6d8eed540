"""The report: one self-contained HTML page per run."""

from drake_landing.report.landing_report import write_report

__all__ = ["write_report"]
