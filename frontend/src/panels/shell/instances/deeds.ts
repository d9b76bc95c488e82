/** Actions for an instance: the buttons below the list, and the menu of a row. */

import { showCompare } from "../../../store/past/comparisons";
import { exportInstance, setPower, showInstances } from "../../../store/plc/instances";
import { t } from "../../../text";
import type { IconName } from "../../../ui/Icon";
import type { Instance } from "../../../wire/types";
import type { Question } from "./Asking";
import { limitsIn } from "./limitsIn";

interface Deed {
  icon: IconName;
  label: string;
  /** A longer description, where the label is not enough. */
  about?: string;
  /** A short note in the menu. */
  hint?: string;
  onSelect: () => void;
}

export function deeds(instance: Instance, onAsk: (question: Question) => void): Deed[] {
  const off = instance.state.state === "off";
  return [
    {
      icon: "off",
      label: t(off ? "instances.power.on" : "instances.power.off"),
      about: t(off ? "instances.power.on.hint" : "instances.power.off.hint"),
      onSelect: () => void setPower(instance, off),
    },
    { icon: "plc", label: t("instances.clone"), onSelect: () => onAsk({ ask: "clone", instance }) },
    { icon: "branch", label: t("instances.branch"), onSelect: () => onAsk({ ask: "branch", instance }) },
    { icon: "swap", label: t("compare.runs"), onSelect: () => compareThis(instance) },
    { icon: "keyboard", label: t("instances.rename"), onSelect: () => onAsk({ ask: "rename", instance }) },
    {
      icon: "fit",
      label: t("instances.limits"),
      about: limitsIn(instance.limits),
      hint: limitsIn(instance.limits),
      onSelect: () => onAsk({ ask: "limits", instance }),
    },
    {
      icon: "export",
      label: t("instances.export"),
      about: t("instances.export.hint"),
      onSelect: () => void exportInstance(instance),
    },
    { icon: "trash", label: t("instances.delete"), onSelect: () => onAsk({ ask: "delete", instance }) },
  ];
}

/** For the instance that the page shows. */
function compareThis(instance: Instance): void {
  showInstances(false);
  showCompare(instance.id);
}
