import { later } from "../../ui/later";

const HelpView = later(() => import("./HelpView"));

/** The help: the pages of `docs/`, loaded when first shown. */
export const HelpPanel = () => (
  <section className="pane flexcol" data-pane="help">
    <HelpView />
  </section>
);
