import { useState } from "react";
import {
  chooseList,
  deleteList,
  duplicateList,
  newList,
  renameList,
  shareList,
  useWatchLists,
} from "../../../store/watch/watchlists";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";

/** Chooses the watch list, and says whether the team shares it. */
export function ListPicker() {
  const { lists, id, content } = useWatchLists();
  const [renaming, setRenaming] = useState(false);
  const kind = t(content.shared ? "watch.list.shared" : "watch.list.private");

  function items(): MenuItem[] {
    const known = lists.map((list) => ({
      label: list.name,
      hint: t(list.shared ? "watch.list.shared" : "watch.list.private"),
      checked: list.id === id,
      onSelect: () => void chooseList(list.id),
    }));
    return [
      ...known,
      {
        label: t("watch.list.new"),
        icon: "plus",
        separated: known.length > 0,
        onSelect: () => void newList(),
      },
      { label: t("watch.list.duplicate"), onSelect: () => void duplicateList() },
      { label: t("watch.list.rename"), onSelect: () => setRenaming(true) },
      { label: t("watch.list.share"), icon: "users", disabled: content.shared, onSelect: shareList },
      {
        label: t("watch.list.delete"),
        icon: "trash",
        separated: true,
        disabled: id === null,
        onSelect: () => void deleteList(),
      },
    ];
  }

  return (
    <>
      <MenuButton
        label={t("watch.list.of", { name: content.name, kind })}
        className="btn quiet sm listpicker"
        items={items}
      >
        <Icon name="list" small />
        <span className="cut">{content.name}</span>
        <span className="faint wide-only">{kind}</span>
        <Icon name="chev-d" small />
      </MenuButton>
      {renaming && (
        <AskName
          title={t("watch.list.rename")}
          label={t("watch.list.name")}
          action={t("watch.list.rename.do")}
          initial={content.name}
          onName={async (name) => {
            if (lists.some((list) => list.name === name && list.id !== id))
              throw new Error(t("watch.list.taken", { name }));
            renameList(name);
          }}
          onClose={() => setRenaming(false)}
        />
      )}
    </>
  );
}
