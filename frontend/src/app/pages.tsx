/** Pages: what stands among the files in the centre without being one. */
import type { ReactNode } from "react";
import { SweepPage } from "../panels/sweep/SweepPage";
import type { PageName } from "../store/navigate";
import { useSweepTitle } from "../store/sweeps";
import type { IconName } from "../ui/Icon";

interface Page {
  component: () => ReactNode;
  icon: IconName;
  /** A hook: the title may follow what the page shows. */
  useTitle: () => string;
}

export const PAGES: Record<PageName, Page> = {
  sweep: { component: SweepPage, icon: "generated", useTitle: useSweepTitle },
};

export const pageComponents = Object.fromEntries(Object.entries(PAGES).map(([name, page]) => [name, page.component]));
