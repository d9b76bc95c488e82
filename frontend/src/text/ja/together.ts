/** Japanese: people at one project. */
import type { together as english } from "../en/together";

export const together: Record<keyof typeof english, string> = {
  "alone.about": "PLC はほかの人のために動き続けます。ここでの書き込みと強制はここだけのもので、戻ると削除されます。",
  "alone.ask.about":
    "ほかの人もこの PLC を使っています。全員に見せると PLC は待ちます。自分だけで見ると PLC は動き続けます。",
  "alone.ask.label": "過去へ移動",
  "alone.ask.title": "スキャン {scan} へ:",
  "alone.end": "{name} に戻る",
  "alone.everybody": "全員に見せる",
  "alone.label": "自分だけで見ています",
  "alone.look": "自分だけで見る",
  "alone.title": "スキャン {scan} の前の {name} を自分だけで見ています。",
  "alone.trouble": "今は自分だけで見ることができません: {message}",
  "follow.about": "同じものが見えます。自分でキー、クリック、スクロールを使うと終わります。",
  "follow.end": "追うのをやめる",
  "follow.label": "だれかを追っています",
  "follow.title": "{name} を追っています。",
  "invite.about":
    "このアドレスを開いた人は、このサーバーであなたと同じことができます。すべてのプロジェクトの閲覧と変更、すべての PLC への書き込み、削除です。信頼できる人にだけ渡してください。",
  "invite.address": "トークン付きのアドレス",
  "invite.copy": "アドレスをコピー",
  "invite.menu": "招待…",
  "invite.own":
    "{host} はコンピューターごとに別のコンピューターを指します。先にサーバーのコンピューターの名前かアドレスでこのページを開き、それから招待してください。",
  "invite.title": "だれかを招待",
  "name.about":
    "ほかの人には、カーソル、一覧、履歴で見えます。自分のウォッチ一覧は名前に属します。新しい名前では新しい一覧から始まります。このブラウザーが名前を保存します。",
  "name.ask": "ほかの人には {name} と見えています。",
  "name.ask.about": "お名前は何ですか。カーソルと操作の横に表示されます。",
  "name.label": "名前",
  "name.menu": "名前を変更…",
  "name.stay": "{name} のまま",
  "name.title": "名前",
  "name.use": "この名前を使う",
  "people.at": "{file}、{line} 行目",
  "people.follow": "{name} を追う",
  "people.goto": "{name}: {place}",
  "people.menu": "人。あなたは {name}: ほかの人の居場所、追う、招待、名前の変更",
  "people.nofile": "ファイルなし",
  "people.past": "過去、スキャン {scan}",
};
