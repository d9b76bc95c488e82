"""Reports of campaigns: one that broke off does not look as if all were well."""

import pytest
from lxml import etree

from scanbench.history.campaign.contract import Campaign, CampaignWanted, Trial
from scanbench.reports.campaign_report import CampaignReport, campaign_json, campaign_junit, campaign_text

TRIAL = Trial(1, "Memory Main.n, bit 3, once in scan 5", "flip", 5, "verification", "Main.n is 8, and should be 0")


@pytest.mark.parametrize("tried", [0, 1, 2])
def test_what_was_not_tried_is_told(tried: int) -> None:
    report = CampaignReport("line", "CJ1M-CPU63", Campaign(CampaignWanted(count=2), (TRIAL,) * tried), 2)
    suite = etree.fromstring(campaign_junit(report).encode())
    found = [each.get("message") for each in suite.findall(".//testcase/error")]
    text = f"only {tried} of 2 disturbances were tried"
    assert found == ([] if tried == 2 else [text])
    assert (suite.get("tests"), suite.get("errors")) == (str(len(suite.findall(".//testcase"))), str(len(found)))
    assert (f"  {text}" in campaign_text(report)) == (tried < 2)
    assert campaign_json(report)["whole"] == (tried == 2)
