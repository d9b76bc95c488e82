import { testedOf } from "../../../logic/errors/catalogue";
import { instancesByKind } from "../../../logic/plc/errorInstances";
import { useCatalogue } from "../../../store/errors/catalogue";
import { recordAddress } from "../../../store/errors/records";
import { askDetails, targets, useSimulator } from "../../../store/errors/simulator";
import { keepState, openSweep, showSweeps } from "../../../store/errors/sweeps";
import { openUserErrors } from "../../../store/errors/userErrors";
import { openPage, showPanel } from "../../../store/page/navigate";
import { useBench } from "../../../store/plc/bench";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";

/** The printable record: a page of its own, which the browser prints or saves. */
function openRecord(): void {
  const { instance } = useBench.getState();
  if (!instance) return;
  window.open(recordAddress(instance.id, "html"), "_blank", "noopener");
}

/** The end of the error simulator's tab strip: how much of the catalogue was tested, and other actions. */
export function PanelEnd() {
  const { errors } = useCatalogue();
  const history = usePlc((plc) => plc.errors);
  const known = usePlc((plc) => plc.instances);
  const hardware = useBench((bench) => bench.model?.hardware ?? false);
  if (errors.length === 0) return null;
  const { tested, total } = testedOf(errors, { hardware, history, instances: instancesByKind(known) });

  function items(): MenuItem[] {
    return [
      {
        label: t("errors.ask"),
        icon: "generated",
        hint: t("errors.ask.hint"),
        disabled: targets(useSimulator.getState()).length === 0,
        onSelect: () => askDetails(errors),
      },
      { label: t("errors.menu.runall"), icon: "refresh", separated: true, onSelect: openSweep },
      { label: t("errors.menu.keep"), icon: "record", onSelect: () => keepState() },
      { label: t("sweep.tab.list"), icon: "handled", onSelect: showSweeps },
      { label: t("errors.menu.user"), icon: "plus", onSelect: () => openUserErrors() },
      { label: t("errors.menu.hardware"), icon: "plc", onSelect: () => openPage("hardware") },
      { label: t("device.open"), icon: "warning", separated: true, onSelect: () => openPage("plcerrors") },
      { label: t("errors.menu.history"), icon: "list", onSelect: () => showPanel("history") },
      { label: t("errors.menu.record"), icon: "export", hint: t("record.newtab"), onSelect: openRecord },
    ];
  }

  return (
    <span className="panelend">
      <span className="tested">{t("errors.tested", { tested, total })}</span>
      <MenuButton label={t("errors.menu")} className="ib sm" items={items}>
        <Icon name="more" />
      </MenuButton>
    </span>
  );
}
