/** Pages: panels in the centre, among the files, that show no file. */
import type { ReactNode } from "react";
import { DevicePage } from "../panels/errors/device/DevicePage";
import { HardwarePage } from "../panels/errors/hardware/HardwarePage";
import { RecordPage } from "../panels/errors/history/RecordPage";
import { SweepPage } from "../panels/errors/sweep/SweepPage";
import { UserErrorsPage } from "../panels/errors/usererrors/UserErrorsPage";
import { HelpPanel } from "../panels/help/HelpPanel";
import { RackPage } from "../panels/operator/RackPage";
import { CallsPage } from "../panels/project/calls/CallsPage";
import { CrossPage } from "../panels/project/cross/CrossPage";
import { VersionsPage } from "../panels/project/editor/VersionsPage";
import { CommunicationPage } from "../panels/run/communication/CommunicationPage";
import { ComparePage } from "../panels/run/past/ComparePage";
import { CampaignPage } from "../panels/verify/campaign/CampaignPage";
import { WhatIfPage } from "../panels/verify/whatif/WhatIfPage";
import { MemoryPage } from "../panels/watch/memory/MemoryPage";
import { useHardwareEdited } from "../store/errors/hardware";
import { useRecordTitle } from "../store/errors/records";
import { useSweepTitle } from "../store/errors/sweeps";
import { isEdited, useUserErrors } from "../store/errors/userErrors";
import type { PageName } from "../store/page/navigate";
import { t } from "../text";
import type { IconName } from "../ui/Icon";

interface Page {
  component: () => ReactNode;
  icon: IconName;
  /** A hook: the title may depend on what the page shows. */
  useTitle: () => string;
}

export const PAGES: Record<PageName, Page> = {
  sweep: { component: SweepPage, icon: "generated", useTitle: useSweepTitle },
  plcerrors: { component: DevicePage, icon: "warning", useTitle: () => t("device.title") },
  hardware: { component: HardwarePage, icon: "plc", useTitle: useHardwareTitle },
  record: { component: RecordPage, icon: "import", useTitle: useRecordTitle },
  compare: { component: ComparePage, icon: "swap", useTitle: () => t("compare.tab") },
  whatif: { component: WhatIfPage, icon: "branch", useTitle: () => t("whatif.tab") },
  campaign: { component: CampaignPage, icon: "disturbance", useTitle: () => t("campaign.tab") },
  versions: { component: VersionsPage, icon: "branch", useTitle: () => t("versions.title") },
  cross: { component: CrossPage, icon: "swap", useTitle: () => t("cross.title") },
  calls: { component: CallsPage, icon: "stack", useTitle: () => t("calls.title") },
  communication: { component: CommunicationPage, icon: "link", useTitle: () => t("communication.title") },
  help: { component: HelpPanel, icon: "help", useTitle: () => t("help.title") },
  memory: { component: MemoryPage, icon: "mem", useTitle: () => t("memory.title") },
  rack: { component: RackPage, icon: "plc", useTitle: () => t("rack.title") },
  usererrors: { component: UserErrorsPage, icon: "list", useTitle: useUserErrorsTitle },
};

function useHardwareTitle(): string {
  const edited = useHardwareEdited();
  return edited ? `${t("hardware.title")}, ${t("unsaved")}` : t("hardware.title");
}

function useUserErrorsTitle(): string {
  const edited = useUserErrors(isEdited);
  return edited ? `${t("usererrors.title")}, ${t("unsaved")}` : t("usererrors.title");
}

export const pageComponents = Object.fromEntries(Object.entries(PAGES).map(([name, page]) => [name, page.component]));
