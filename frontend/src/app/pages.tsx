/** Pages: what stands among the files in the centre without being one. */
import type { ReactNode } from "react";
import { RecordPage } from "../panels/history/RecordPage";
import { ComparePage } from "../panels/past/ComparePage";
import { SweepPage } from "../panels/sweep/SweepPage";
import { UserErrorsPage } from "../panels/usererrors/UserErrorsPage";
import type { PageName } from "../store/navigate";
import { useRecordTitle } from "../store/records";
import { useSweepTitle } from "../store/sweeps";
import { isEdited, useUserErrors } from "../store/userErrors";
import { t } from "../text";
import type { IconName } from "../ui/Icon";

interface Page {
  component: () => ReactNode;
  icon: IconName;
  /** A hook: the title may follow what the page shows. */
  useTitle: () => string;
}

export const PAGES: Record<PageName, Page> = {
  sweep: { component: SweepPage, icon: "generated", useTitle: useSweepTitle },
  record: { component: RecordPage, icon: "import", useTitle: useRecordTitle },
  compare: { component: ComparePage, icon: "swap", useTitle: () => t("compare.tab") },
  usererrors: { component: UserErrorsPage, icon: "list", useTitle: useUserErrorsTitle },
};

function useUserErrorsTitle(): string {
  const edited = useUserErrors(isEdited);
  return edited ? `${t("usererrors.title")}, ${t("unsaved")}` : t("usererrors.title");
}

export const pageComponents = Object.fromEntries(Object.entries(PAGES).map(([name, page]) => [name, page.component]));
