import { useState } from "react";
import { useBench } from "../../../store/plc/bench";
import { topVariables } from "../../../store/plc/completion";
import { addToWatch } from "../../../store/watch/watchlist";
import { chooseList, useWatchLists } from "../../../store/watch/watchlists";
import { t } from "../../../text";
import { Empty } from "../../../ui/Empty";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";

/** An empty list says how to add entries, and offers the ones most people want. */
export function EmptyWatch() {
  const instance = useBench((bench) => bench.instance);
  const model = useBench((bench) => bench.model);
  const [none, setNone] = useState<string | null>(null);
  if (!instance) return <p className="lonely faint">{t("watch.noinstance")}</p>;
  const words = model?.status_words ?? [];

  async function addProgram(): Promise<void> {
    const { paths, refused } = await topVariables();
    if (paths.length > 0) addToWatch(paths);
    else setNone(refused ?? t("watch.addprogram.none"));
  }

  return (
    <Empty
      title={t("watch.empty.title")}
      about={t("watch.empty.about")}
      ways={[
        { icon: "keyboard", strong: t("watch.empty.type"), rest: t("watch.empty.type.rest") },
        { icon: "drag", strong: t("watch.empty.drag"), rest: t("watch.empty.drag.rest") },
        { icon: "mouse", strong: t("watch.empty.click"), rest: t("watch.empty.click.rest") },
      ]}
    >
      <h3 className="small">{t("watch.empty.often")}</h3>
      <div className="offersrow">
        {words.map((word) => (
          <button key={word} type="button" className="tr offer" onClick={() => addToWatch([word])}>
            <Icon name="plus" />
            <span className="mono">{word}</span>
            <span className="meta">{word === model?.code_word ? t("watch.codeword") : t("watch.statusword")}</span>
          </button>
        ))}
      </div>
      <button type="button" className="btn sm" onClick={() => void addProgram()}>
        <Icon name="plus" small />
        {t("watch.addprogram")}
      </button>{" "}
      <SharedLists />
      <p className="none" role="status">
        {none}
      </p>
    </Empty>
  );
}

/** What others watch is often a good start. */
function SharedLists() {
  const { lists, id } = useWatchLists();
  const shared = lists.filter((list) => list.shared && list.id !== id && list.count > 0);
  if (shared.length === 0) return null;
  return (
    <MenuButton
      label={t("watch.empty.shared")}
      className="btn sm"
      items={() =>
        shared.map((list) => ({ label: list.name, hint: String(list.count), onSelect: () => void chooseList(list.id) }))
      }
    >
      <Icon name="users" small />
      {t("watch.empty.shared")}
    </MenuButton>
  );
}
