import { useRef } from "react";
import { importRecord, recordAddress, showRecord, useRecords } from "../../../store/errors/records";
import { useOnline } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";

const LISTED = 8;

/** Exports and imports the test record: as a printable page, as files. */
export function RecordMenu() {
  const { instance, list } = useRecords();
  const online = useOnline();
  const file = useRef<HTMLInputElement>(null);
  const none = instance === null || !online;

  function items(): MenuItem[] {
    return [
      {
        label: t("record.print"),
        icon: "export",
        hint: t("record.newtab"),
        disabled: none,
        onSelect: () => open("html"),
      },
      { label: t("record.xml"), icon: "export", disabled: none, onSelect: () => open("xml") },
      { label: t("record.csv"), icon: "export", disabled: none, onSelect: () => open("csv") },
      { label: t("record.import"), icon: "import", separated: true, onSelect: () => file.current?.click() },
      ...list.slice(0, LISTED).map(({ id, title }, index) => ({
        label: title,
        separated: index === 0,
        onSelect: () => showRecord(id),
      })),
    ];
  }

  return (
    <>
      <MenuButton label={t("record.menu")} className="btn sm" items={items}>
        {t("record.menu")}
        <Icon name="chev-d" small />
      </MenuButton>
      <input
        ref={file}
        type="file"
        hidden
        accept=".xml,application/xml,text/xml"
        onChange={(event) => {
          const chosen = event.target.files?.[0];
          event.target.value = ""; // choosing the same file again counts as a change, too
          if (chosen) void importRecord(chosen);
        }}
      />
    </>
  );
}

/** The record of the shown version. */
function open(format: "html" | "xml" | "csv"): void {
  const { instance, old } = useRecords.getState();
  if (instance !== null) openAddress(recordAddress(instance, format, old?.version), format === "html");
}

/** Opens a document in a new tab, or downloads a file. */
export function openAddress(address: string, tab: boolean): void {
  const link = document.createElement("a");
  link.href = address;
  if (tab) {
    link.target = "_blank";
    link.rel = "noopener";
  } else link.download = "";
  link.click();
}
