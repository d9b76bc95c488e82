BEGIN TRANSACTION;
CREATE TABLE "accepted_finding" (
	project_id INTEGER NOT NULL, 
	error VARCHAR(255) NOT NULL, 
	state VARCHAR(100) NOT NULL, 
	reason TEXT NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_accepted_finding PRIMARY KEY (project_id, error, state), 
	CONSTRAINT fk_accepted_finding_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "accepted_finding" VALUES(1,'fal','Idle','no such instruction is used','Ada Lovelace','2026-11-24 14:27:01.374649');
CREATE TABLE alembic_version (
	version_num VARCHAR(32) NOT NULL, 
	CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num)
);
INSERT INTO "alembic_version" VALUES('0015');
CREATE TABLE breakpoint (
	instance_id INTEGER NOT NULL, 
	number INTEGER NOT NULL, 
	content JSON NOT NULL, 
	CONSTRAINT pk_breakpoint PRIMARY KEY (instance_id, number), 
	CONSTRAINT fk_breakpoint_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE CASCADE
);
INSERT INTO "breakpoint" VALUES(1,0,'{"id": 1, "kind": "line", "author": "Ada Lovelace", "group": "", "enabled": false, "file": "main.st", "line": 8, "column": 0, "path": "", "access": "change", "error": "", "scan": 0, "condition": "Main.n > 1000000", "hits": ">= 3", "log": "n is {n}", "assign": "", "instance": "", "task": ""}');
INSERT INTO "breakpoint" VALUES(1,1,'{"id": 2, "kind": "data", "author": "Ada Lovelace", "group": "", "enabled": false, "file": "", "line": 0, "column": 0, "path": "Main.level", "access": "write", "error": "", "scan": 0, "condition": "", "hits": "", "log": "", "assign": "", "instance": "", "task": ""}');
INSERT INTO "breakpoint" VALUES(1,2,'{"id": 3, "kind": "scan", "author": "Ada Lovelace", "group": "", "enabled": true, "file": "", "line": 0, "column": 0, "path": "", "access": "change", "error": "", "scan": 1099511627776, "condition": "", "hits": "", "log": "", "assign": "", "instance": "", "task": ""}');
CREATE TABLE draft (
	project_id INTEGER NOT NULL, 
	path VARCHAR(255) NOT NULL, 
	"key" VARCHAR(64) NOT NULL, 
	CONSTRAINT pk_draft PRIMARY KEY (project_id, path), 
	CONSTRAINT fk_draft_file FOREIGN KEY(project_id, path) REFERENCES file (project_id, path) ON DELETE CASCADE
);
INSERT INTO "draft" VALUES(1,'main.st','81755bfd-b787-4215-9b26-7ccc0b27066e');
CREATE TABLE draft_part (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	path VARCHAR(255) NOT NULL, 
	data BLOB NOT NULL, 
	CONSTRAINT pk_draft_part PRIMARY KEY (id), 
	CONSTRAINT fk_draft_part_draft FOREIGN KEY(project_id, path) REFERENCES draft (project_id, path) ON DELETE CASCADE
);
INSERT INTO "draft_part" VALUES(1,1,'main.st',X'0101DFF78FD3B4D49B0F0004010474657874C2065459504520436F6C6F72203A20287265642C20677265656E2C20626C7565293B20454E445F545950450A50524F4752414D204D61696E0A5641520A20206E203A2044494E543B206C6576656C203A20494E54203A3D203130303B20646F75626C6564203A20494E543B20636F6C6F72203A20436F6C6F723B207370656564203A205245414C3B2066696E65203A204C5245414C3B2077616974203A2054494D453B2074657874203A20535452494E475B31325D3B0A20206C616D702041542043494F203130302E3030203A20424F4F4C3B2072656164792041542043494F20302E3030203A20424F4F4C3B20626173696320415420413430322E3132203A20424F4F4C3B206261747465727920415420413430322E3034203A20424F4F4C3B20686F74204154205731302E3030203A20424F4F4C3B0A202062656C74203A2052616D703B0A454E445F5641520A20206E203A3D206E202B20323B0A2020646F75626C6564203A3D206C6576656C202A20323B0A20204946206E204D4F442032203D2030205448454E20636F6C6F72203A3D207265643B20454C534520636F6C6F72203A3D20626C75653B20454E445F49463B0A20207370656564203A3D2044494E545F544F5F5245414C286E29202F20342E303B2066696E65203A3D2066696E65202B20302E313B2077616974203A3D2077616974202B20542331306D733B0A20204946206261736963204F5220686F74205448454E206C616D70203A3D20545255453B20454E445F49463B0A202049462062617474657279205448454E203B20454E445F49463B0A20204946206E203E203330205448454E2074657874203A3D202768696768273B20454C53452074657874203A3D20276C6F77273B20454E445F49463B0A202062656C7428746172676574203A3D20363030293B0A454E445F50524F4752414D0A46554E4354494F4E5F424C4F434B2052616D700A5641525F494E50555420746172676574203A20494E543B20454E445F5641520A5641525F4F5554505554207370656564203A20494E543B20454E445F5641520A20207370656564203A3D204C494D4954287370656564202D2032352C207461726765742C207370656564202B203235293B0A454E445F46554E4354494F4E5F424C4F434B0A00');
INSERT INTO "draft_part" VALUES(2,1,'main.st',X'0101B3B782E5B2C5AC010044DFF78FD3B4D49B0F0010282A206E6F74207361766564202A292000');
CREATE TABLE "error_history" (
	instance_id INTEGER NOT NULL, 
	error VARCHAR(255) NOT NULL, 
	program_version INTEGER NOT NULL, 
	status VARCHAR(16) NOT NULL, 
	code VARCHAR(16) NOT NULL, 
	details TEXT NOT NULL, 
	generated_at DATETIME NOT NULL, 
	recovered_at DATETIME, 
	generated_scan BIGINT NOT NULL, 
	recovered_scan BIGINT, 
	"by" VARCHAR(100) NOT NULL, 
	origin VARCHAR(16) NOT NULL, 
	count INTEGER NOT NULL, 
	reaction JSON, 
	reaction_state VARCHAR(16), 
	reaction_message TEXT DEFAULT ('') NOT NULL, recovered_by VARCHAR(100) DEFAULT '' NOT NULL, recovered_way VARCHAR(16), 
	CONSTRAINT pk_error_history PRIMARY KEY (instance_id, program_version, error), 
	CONSTRAINT fk_error_history_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE CASCADE
);
INSERT INTO "error_history" VALUES(1,'basic-io-error:rack=0,slot=0',1,'cleared','009A','rack=0, slot=0','2026-11-24 14:27:00.593524','2026-11-24 14:27:00.794375',40,440,'Ada Lovelace','simulator',1,'{"verdict": "acted", "window": 200, "first_read": 1, "first_effect": 1, "readers": [{"file": "main.st", "line": 12, "pou": "Main", "what": "flag", "scan": 1}], "differences": [{"path": "Main.lamp", "without": "FALSE", "value": "TRUE", "output": true, "scan": 1}], "difference_count": 1, "lines": [{"file": "main.st", "line": 12}], "note": "", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [{"text": "Main.lamp within 2 scans", "line": 4, "outcome": "passed", "recovery": false, "scan": 1, "values": [{"path": "Main.lamp", "value": "TRUE"}], "reason": "", "note": ""}, {"text": "Main.lamp", "line": 5, "outcome": "not_checked", "recovery": false, "scan": null, "values": [], "reason": "other_state", "note": "a PLC that somebody works with is in none of the states of a sweep"}], "restarts": [], "recovery": 0}','done','','Ada Lovelace','simulator');
INSERT INTO "error_history" VALUES(1,'pump-hot',1,'generated','4101','pump=north','2026-11-24 14:27:00.729655',NULL,240,NULL,'Ada Lovelace','simulator',1,'{"verdict": "no_effect", "window": 200, "first_read": 1, "first_effect": null, "readers": [{"file": "main.st", "line": 12, "pou": "Main", "what": "flag", "scan": 1}], "differences": [], "difference_count": 0, "lines": [], "note": "basic-io-error:rack=0,slot=0 was present before: what follows from both is no difference", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [{"text": "Main.lamp within 2 scans", "line": 6, "outcome": "passed", "recovery": false, "scan": 1, "values": [{"path": "Main.lamp", "value": "TRUE"}], "reason": "", "note": ""}], "restarts": [], "recovery": 0}','done','','',NULL);
INSERT INTO "error_history" VALUES(1,'pump-hot',2,'generated','4101','pump=north','2026-11-24 14:27:00.729655',NULL,240,NULL,'Ada Lovelace','simulator',1,NULL,NULL,'','',NULL);
INSERT INTO "error_history" VALUES(1,'battery-error',2,'generated','00F7','','2026-11-24 14:27:01.857289',NULL,445,NULL,'Ada Lovelace','simulator',1,NULL,'recording','','',NULL);
CREATE TABLE file (
	project_id INTEGER NOT NULL, 
	path VARCHAR(255) NOT NULL, 
	text TEXT NOT NULL, 
	version INTEGER NOT NULL, 
	author VARCHAR(100) NOT NULL, 
	saved DATETIME NOT NULL, 
	CONSTRAINT pk_file PRIMARY KEY (project_id, path), 
	CONSTRAINT fk_file_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "file" VALUES(1,'main.st','TYPE Color : (red, green, blue); END_TYPE
PROGRAM Main
VAR
  n : DINT; level : INT := 100; doubled : INT; color : Color; speed : REAL; fine : LREAL; wait : TIME; text : STRING[12];
  lamp AT CIO 100.00 : BOOL; ready AT CIO 0.00 : BOOL; basic AT A402.12 : BOOL; battery AT A402.04 : BOOL; hot AT W10.00 : BOOL;
  belt : Ramp;
END_VAR
  n := n + 2;
  doubled := level * 2;
  IF n MOD 2 = 0 THEN color := red; ELSE color := blue; END_IF;
  speed := DINT_TO_REAL(n) / 4.0; fine := fine + 0.1; wait := wait + T#10ms;
  IF basic OR hot THEN lamp := TRUE; END_IF;
  IF battery THEN ; END_IF;
  IF n > 30 THEN text := ''high''; ELSE text := ''low''; END_IF;
  belt(target := 600);
END_PROGRAM
FUNCTION_BLOCK Ramp
VAR_INPUT target : INT; END_VAR
VAR_OUTPUT speed : INT; END_VAR
  speed := LIMIT(speed - 25, target, speed + 25);
END_FUNCTION_BLOCK
',2,'Bob Noyce','2026-11-24 14:27:01.651320');
INSERT INTO "file" VALUES(1,'required.reactions','battery-error:
  at least acted
  Main.lamp within 2 scans
basic-io-error: Main.lamp within 2 scans
basic-io-error in Idel: Main.lamp
pump-hot: Main.lamp within 2 scans
batery-error: Main.lamp
',1,'Ada Lovelace','2026-11-24 14:26:58.790754');
INSERT INTO "file" VALUES(1,'errors.xml','<?xml version="1.0" encoding="UTF-8"?>
<UserErrors>
  <ErrorGroup>
    <Name>Pumps</Name>
    <Error Id="pump-hot" ErrorCode="4101" ErrorFlag="W10.00" Severity="nonfatal" Priority="300">
      <Name>Pump hot</Name>
      <Name xml:lang="ja">ポンプ過熱</Name>
      <ErrorDetailPattern>
        <ErrorControl Name="pump" Type="List">
          <ErrorAddress Id="north" Address="W12.03" Type="Bit"/>
          <ErrorAddress Id="south" Address="W12.04" Type="Bit"/>
        </ErrorControl>
      </ErrorDetailPattern>
    </Error>
  </ErrorGroup>
</UserErrors>
',1,'Ada Lovelace','2026-11-24 14:26:58.937803');
CREATE TABLE instance (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	created DATETIME NOT NULL, 
	powered BOOLEAN DEFAULT 1 NOT NULL, 
	memory_mib INTEGER, 
	cpu_percent INTEGER, 
	run_mib INTEGER, look BOOLEAN DEFAULT 0 NOT NULL, 
	CONSTRAINT pk_instance PRIMARY KEY (id), 
	CONSTRAINT uq_instance_name UNIQUE (name), 
	CONSTRAINT fk_instance_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "instance" VALUES(1,1,'line 1','2026-11-24 14:27:00.051418',1,NULL,NULL,NULL,0);
INSERT INTO "instance" VALUES(2,1,'line 2','2026-11-24 14:27:01.867845',0,2000,NULL,100,0);
CREATE TABLE log (
	id INTEGER NOT NULL, 
	instance_id INTEGER NOT NULL, 
	at DATETIME NOT NULL, 
	scan BIGINT NOT NULL, 
	author VARCHAR(100) NOT NULL, 
	kind VARCHAR(16) NOT NULL, 
	text TEXT NOT NULL, 
	program_version INTEGER, 
	CONSTRAINT pk_log PRIMARY KEY (id), 
	CONSTRAINT fk_log_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE CASCADE
);
INSERT INTO "log" VALUES(1,1,'2026-11-24 14:27:00.279502',0,'Ada Lovelace','run','pause, speed x1',1);
INSERT INTO "log" VALUES(2,1,'2026-11-24 14:27:00.570215',0,'Ada Lovelace','run','continue: scan 40, as fast as possible',1);
INSERT INTO "log" VALUES(3,1,'2026-11-24 14:27:00.593524',40,'Ada Lovelace','error','generated basic-io-error (rack=0, slot=0), code 009A',1);
INSERT INTO "log" VALUES(4,1,'2026-11-24 14:27:00.599367',40,'Ada Lovelace','run','continue: scan 240, as fast as possible',1);
INSERT INTO "log" VALUES(5,1,'2026-11-24 14:27:00.729655',240,'Ada Lovelace','error','generated pump-hot (pump=north), code 4101',1);
INSERT INTO "log" VALUES(6,1,'2026-11-24 14:27:00.737220',240,'Ada Lovelace','run','continue: scan 440, as fast as possible',1);
INSERT INTO "log" VALUES(7,1,'2026-11-24 14:27:00.794375',440,'Ada Lovelace','recover','recovered basic-io-error',1);
INSERT INTO "log" VALUES(8,1,'2026-11-24 14:27:00.843294',440,'Ada Lovelace','disturbance','disturbance 1: Result of main.st:9, bit 3, once in scan 442',1);
INSERT INTO "log" VALUES(9,1,'2026-11-24 14:27:00.848938',440,'Ada Lovelace','run','continue: scan 445, as fast as possible',1);
INSERT INTO "log" VALUES(10,1,'2026-11-24 14:27:00.855613',442,'Ada Lovelace','disturbance','Result of main.st:9: bit 3 of Main.doubled turned over',1);
INSERT INTO "log" VALUES(11,1,'2026-11-24 14:27:00.913896',445,'Ada Lovelace','run','verification 1 begins: Main, lines 8 to 10',1);
INSERT INTO "log" VALUES(12,1,'2026-11-24 14:27:00.958450',445,'Ada Lovelace','run','state kept: Idle',1);
INSERT INTO "log" VALUES(13,1,'2026-11-24 14:27:00.961297',445,'Ada Lovelace','write','Main.ready := TRUE',1);
INSERT INTO "log" VALUES(14,1,'2026-11-24 14:27:00.969750',445,'Bob Noyce','run','state kept: Ready',1);
INSERT INTO "log" VALUES(15,1,'2026-11-24 14:27:00.975164',445,'Ada Lovelace','run','sweep begun: 5 errors from Idle, Ready',1);
INSERT INTO "log" VALUES(16,1,'2026-11-24 14:27:01.839154',445,'Bob Noyce','build','program version 2: 10 variables kept',2);
INSERT INTO "log" VALUES(17,1,'2026-11-24 14:27:01.857289',445,'Ada Lovelace','error','generated battery-error, code 00F7',2);
INSERT INTO "log" VALUES(18,1,'2026-11-24 14:27:01.861985',445,'Ada Lovelace','run','continue: scan 447, as fast as possible',2);
INSERT INTO "log" VALUES(19,2,'2026-11-24 14:27:01.964904',0,'Ada Lovelace','run','switched off',2);
CREATE TABLE person (
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	colour INTEGER NOT NULL, 
	CONSTRAINT pk_person PRIMARY KEY (project_id, name), 
	CONSTRAINT fk_person_project_id_project FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "person" VALUES(1,'Ada Lovelace',0);
CREATE TABLE program_state (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	instance VARCHAR(100) NOT NULL, 
	scan BIGINT NOT NULL, 
	program_version INTEGER NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_program_state PRIMARY KEY (id), 
	CONSTRAINT uq_program_state_project_id_name UNIQUE (project_id, name), 
	CONSTRAINT fk_program_state_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "program_state" VALUES(1,1,'Idle','line 1',445,1,'Ada Lovelace','2026-11-24 14:27:00.948361');
INSERT INTO "program_state" VALUES(2,1,'Ready','line 1',445,1,'Bob Noyce','2026-11-24 14:27:00.967547');
CREATE TABLE program_version (
	project_id INTEGER NOT NULL, 
	version INTEGER NOT NULL, 
	sources JSON NOT NULL, 
	hash VARCHAR(64) NOT NULL, 
	author VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, label VARCHAR(100) DEFAULT '' NOT NULL, message TEXT DEFAULT '' NOT NULL, 
	CONSTRAINT pk_program_version PRIMARY KEY (project_id, version), 
	CONSTRAINT fk_program_version_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "program_version" VALUES(1,1,'{"errors.xml": "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<UserErrors>\n  <ErrorGroup>\n    <Name>Pumps</Name>\n    <Error Id=\"pump-hot\" ErrorCode=\"4101\" ErrorFlag=\"W10.00\" Severity=\"nonfatal\" Priority=\"300\">\n      <Name>Pump hot</Name>\n      <Name xml:lang=\"ja\">\u30dd\u30f3\u30d7\u904e\u71b1</Name>\n      <ErrorDetailPattern>\n        <ErrorControl Name=\"pump\" Type=\"List\">\n          <ErrorAddress Id=\"north\" Address=\"W12.03\" Type=\"Bit\"/>\n          <ErrorAddress Id=\"south\" Address=\"W12.04\" Type=\"Bit\"/>\n        </ErrorControl>\n      </ErrorDetailPattern>\n    </Error>\n  </ErrorGroup>\n</UserErrors>\n", "main.st": "TYPE Color : (red, green, blue); END_TYPE\nPROGRAM Main\nVAR\n  n : DINT; level : INT := 100; doubled : INT; color : Color; speed : REAL; fine : LREAL; wait : TIME; text : STRING[12];\n  lamp AT CIO 100.00 : BOOL; ready AT CIO 0.00 : BOOL; basic AT A402.12 : BOOL; battery AT A402.04 : BOOL; hot AT W10.00 : BOOL;\n  belt : Ramp;\nEND_VAR\n  n := n + 1;\n  doubled := level * 2;\n  IF n MOD 2 = 0 THEN color := red; ELSE color := blue; END_IF;\n  speed := DINT_TO_REAL(n) / 4.0; fine := fine + 0.1; wait := wait + T#10ms;\n  IF basic OR hot THEN lamp := TRUE; END_IF;\n  IF battery THEN ; END_IF;\n  IF n > 30 THEN text := ''high''; ELSE text := ''low''; END_IF;\n  belt(target := 600);\nEND_PROGRAM\nFUNCTION_BLOCK Ramp\nVAR_INPUT target : INT; END_VAR\nVAR_OUTPUT speed : INT; END_VAR\n  speed := LIMIT(speed - 25, target, speed + 25);\nEND_FUNCTION_BLOCK\n", "required.reactions": "battery-error:\n  at least acted\n  Main.lamp within 2 scans\nbasic-io-error: Main.lamp within 2 scans\nbasic-io-error in Idel: Main.lamp\npump-hot: Main.lamp within 2 scans\nbatery-error: Main.lamp\n"}','b383da0df30a62264e4c303b72641f03611ec80f03565e4aac2fe306940e645c','Ada Lovelace','2026-11-24 14:27:00.023285','Accepted','as it was when the belt was accepted');
INSERT INTO "program_version" VALUES(1,2,'{"errors.xml": "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<UserErrors>\n  <ErrorGroup>\n    <Name>Pumps</Name>\n    <Error Id=\"pump-hot\" ErrorCode=\"4101\" ErrorFlag=\"W10.00\" Severity=\"nonfatal\" Priority=\"300\">\n      <Name>Pump hot</Name>\n      <Name xml:lang=\"ja\">\u30dd\u30f3\u30d7\u904e\u71b1</Name>\n      <ErrorDetailPattern>\n        <ErrorControl Name=\"pump\" Type=\"List\">\n          <ErrorAddress Id=\"north\" Address=\"W12.03\" Type=\"Bit\"/>\n          <ErrorAddress Id=\"south\" Address=\"W12.04\" Type=\"Bit\"/>\n        </ErrorControl>\n      </ErrorDetailPattern>\n    </Error>\n  </ErrorGroup>\n</UserErrors>\n", "main.st": "TYPE Color : (red, green, blue); END_TYPE\nPROGRAM Main\nVAR\n  n : DINT; level : INT := 100; doubled : INT; color : Color; speed : REAL; fine : LREAL; wait : TIME; text : STRING[12];\n  lamp AT CIO 100.00 : BOOL; ready AT CIO 0.00 : BOOL; basic AT A402.12 : BOOL; battery AT A402.04 : BOOL; hot AT W10.00 : BOOL;\n  belt : Ramp;\nEND_VAR\n  n := n + 2;\n  doubled := level * 2;\n  IF n MOD 2 = 0 THEN color := red; ELSE color := blue; END_IF;\n  speed := DINT_TO_REAL(n) / 4.0; fine := fine + 0.1; wait := wait + T#10ms;\n  IF basic OR hot THEN lamp := TRUE; END_IF;\n  IF battery THEN ; END_IF;\n  IF n > 30 THEN text := ''high''; ELSE text := ''low''; END_IF;\n  belt(target := 600);\nEND_PROGRAM\nFUNCTION_BLOCK Ramp\nVAR_INPUT target : INT; END_VAR\nVAR_OUTPUT speed : INT; END_VAR\n  speed := LIMIT(speed - 25, target, speed + 25);\nEND_FUNCTION_BLOCK\n", "required.reactions": "battery-error:\n  at least acted\n  Main.lamp within 2 scans\nbasic-io-error: Main.lamp within 2 scans\nbasic-io-error in Idel: Main.lamp\npump-hot: Main.lamp within 2 scans\nbatery-error: Main.lamp\n"}','0bc88af1d615ab50ecf9d9893ef177996aff2374d6a888029f7c1a075388ab34','Bob Noyce','2026-11-24 14:27:01.674088','','');
CREATE TABLE project (
	id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	model VARCHAR(64) NOT NULL, 
	watch JSON NOT NULL, 
	version INTEGER NOT NULL, 
	created DATETIME NOT NULL, 
	CONSTRAINT pk_project PRIMARY KEY (id), 
	CONSTRAINT uq_project_name UNIQUE (name)
);
INSERT INTO "project" VALUES(1,'conveyor','CJ1M-CPU63','["Main.n"]',2,'2026-11-24 14:26:54.782623');
CREATE TABLE sweep (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	instance_id INTEGER, 
	instance VARCHAR(100) NOT NULL, 
	model VARCHAR(64) NOT NULL, 
	program_version INTEGER NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	status VARCHAR(16) NOT NULL, 
	message TEXT NOT NULL, 
	window INTEGER NOT NULL, 
	states JSON NOT NULL, 
	errors JSON NOT NULL, 
	seconds DOUBLE NOT NULL, problems JSON DEFAULT '[]' NOT NULL, 
	CONSTRAINT pk_sweep PRIMARY KEY (id), 
	CONSTRAINT fk_sweep_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE SET NULL, 
	CONSTRAINT fk_sweep_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "sweep" VALUES(1,1,1,'line 1','CJ1M-CPU63',1,'Ada Lovelace','2026-11-24 14:27:00.973218','done','',20,'["Idle", "Ready"]','[{"id": "io-bus-error", "name": "I/O bus error", "code": "80C0", "severity": "fatal", "group": "CPU fatal errors / CPU fatal hardware errors"}, {"id": "fal", "name": "FAL error", "code": "4100", "severity": "nonfatal", "group": "CPU nonfatal errors / CPU Unit"}, {"id": "battery-error", "name": "Battery error", "code": "00F7", "severity": "nonfatal", "group": "CPU nonfatal errors / CPU Unit"}, {"id": "basic-io-error", "name": "Basic I/O Unit error", "code": "009A", "severity": "nonfatal", "group": "CPU nonfatal errors / Units"}, {"id": "pump-hot", "name": "Pump hot", "code": "4101", "severity": "nonfatal", "group": "User-defined / Pumps"}]',0.372142622,'[{"line": 7, "column": 1, "message": "CJ1M-CPU63 knows no error ''batery-error''. Did you mean `battery-error` or `memory-error` or `basic-io-error` or `io-bus-error`? Or write one of all, fatal, nonfatal. The requirement is not checked."}]');
CREATE TABLE "sweep_cell" (
	sweep_id INTEGER NOT NULL, 
	error VARCHAR(255) NOT NULL, 
	state VARCHAR(100) NOT NULL, 
	raised_scan BIGINT NOT NULL, 
	verdict VARCHAR(16), 
	first_read INTEGER, 
	first_effect INTEGER, 
	difference_count INTEGER NOT NULL, 
	note TEXT NOT NULL, 
	reaction JSON, required INTEGER DEFAULT '0' NOT NULL, unmet INTEGER DEFAULT '0' NOT NULL, untried JSON DEFAULT '[]' NOT NULL, 
	CONSTRAINT pk_sweep_cell PRIMARY KEY (sweep_id, error, state), 
	CONSTRAINT fk_sweep_cell_sweep_id FOREIGN KEY(sweep_id) REFERENCES sweep (id) ON DELETE CASCADE
);
INSERT INTO "sweep_cell" VALUES(1,'io-bus-error','Idle',445,'stopped',NULL,NULL,0,'','{"verdict": "stopped", "window": 0, "first_read": null, "first_effect": null, "readers": [], "differences": [], "difference_count": 0, "lines": [], "note": "", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [], "restarts": [], "recovery": 0}',0,0,'[]');
INSERT INTO "sweep_cell" VALUES(1,'io-bus-error','Ready',445,'stopped',NULL,NULL,0,'','{"verdict": "stopped", "window": 0, "first_read": null, "first_effect": null, "readers": [], "differences": [], "difference_count": 0, "lines": [], "note": "", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [], "restarts": [], "recovery": 0}',0,0,'[]');
INSERT INTO "sweep_cell" VALUES(1,'fal','Idle',445,'never_read',NULL,NULL,0,'pump-hot:pump=north was present before: what follows from both is no difference','{"verdict": "never_read", "window": 20, "first_read": null, "first_effect": null, "readers": [], "differences": [], "difference_count": 0, "lines": [], "note": "pump-hot:pump=north was present before: what follows from both is no difference", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [], "restarts": [], "recovery": 0}',0,0,'[]');
INSERT INTO "sweep_cell" VALUES(1,'fal','Ready',445,'never_read',NULL,NULL,0,'pump-hot:pump=north was present before: what follows from both is no difference','{"verdict": "never_read", "window": 20, "first_read": null, "first_effect": null, "readers": [], "differences": [], "difference_count": 0, "lines": [], "note": "pump-hot:pump=north was present before: what follows from both is no difference", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [], "restarts": [], "recovery": 0}',0,0,'[]');
INSERT INTO "sweep_cell" VALUES(1,'battery-error','Idle',445,'no_effect',1,NULL,0,'pump-hot:pump=north was present before: what follows from both is no difference','{"verdict": "no_effect", "window": 20, "first_read": 1, "first_effect": null, "readers": [{"file": "main.st", "line": 13, "pou": "Main", "what": "flag", "scan": 1}], "differences": [], "difference_count": 0, "lines": [], "note": "pump-hot:pump=north was present before: what follows from both is no difference", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [{"text": "at least acted", "line": 2, "outcome": "failed", "recovery": false, "scan": null, "values": [{"path": "verdict", "value": "no_effect"}], "reason": "", "note": ""}, {"text": "Main.lamp within 2 scans", "line": 3, "outcome": "passed", "recovery": false, "scan": 1, "values": [{"path": "Main.lamp", "value": "TRUE"}], "reason": "", "note": ""}], "restarts": [], "recovery": 0}',2,1,'[]');
INSERT INTO "sweep_cell" VALUES(1,'battery-error','Ready',445,'no_effect',1,NULL,0,'pump-hot:pump=north was present before: what follows from both is no difference','{"verdict": "no_effect", "window": 20, "first_read": 1, "first_effect": null, "readers": [{"file": "main.st", "line": 13, "pou": "Main", "what": "flag", "scan": 1}], "differences": [], "difference_count": 0, "lines": [], "note": "pump-hot:pump=north was present before: what follows from both is no difference", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [{"text": "at least acted", "line": 2, "outcome": "failed", "recovery": false, "scan": null, "values": [{"path": "verdict", "value": "no_effect"}], "reason": "", "note": ""}, {"text": "Main.lamp within 2 scans", "line": 3, "outcome": "passed", "recovery": false, "scan": 1, "values": [{"path": "Main.lamp", "value": "TRUE"}], "reason": "", "note": ""}], "restarts": [], "recovery": 0}',2,1,'[]');
INSERT INTO "sweep_cell" VALUES(1,'basic-io-error','Idle',445,'no_effect',1,NULL,0,'pump-hot:pump=north was present before: what follows from both is no difference','{"verdict": "no_effect", "window": 20, "first_read": 1, "first_effect": null, "readers": [{"file": "main.st", "line": 12, "pou": "Main", "what": "flag", "scan": 1}], "differences": [], "difference_count": 0, "lines": [], "note": "pump-hot:pump=north was present before: what follows from both is no difference", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [{"text": "Main.lamp within 2 scans", "line": 4, "outcome": "passed", "recovery": false, "scan": 1, "values": [{"path": "Main.lamp", "value": "TRUE"}], "reason": "", "note": ""}, {"text": "Main.lamp", "line": 5, "outcome": "not_checked", "recovery": false, "scan": null, "values": [], "reason": "no_state", "note": "there is no state `Idel`. Did you mean `Idle`?"}], "restarts": [], "recovery": 0}',2,1,'[]');
INSERT INTO "sweep_cell" VALUES(1,'basic-io-error','Ready',445,'no_effect',1,NULL,0,'pump-hot:pump=north was present before: what follows from both is no difference','{"verdict": "no_effect", "window": 20, "first_read": 1, "first_effect": null, "readers": [{"file": "main.st", "line": 12, "pou": "Main", "what": "flag", "scan": 1}], "differences": [], "difference_count": 0, "lines": [], "note": "pump-hot:pump=north was present before: what follows from both is no difference", "basis": "exact", "carried": [], "decided_by": [], "displayed": [], "unreached": [], "required": [{"text": "Main.lamp within 2 scans", "line": 4, "outcome": "passed", "recovery": false, "scan": 1, "values": [{"path": "Main.lamp", "value": "TRUE"}], "reason": "", "note": ""}], "restarts": [], "recovery": 0}',1,0,'[]');
INSERT INTO "sweep_cell" VALUES(1,'pump-hot','Idle',445,NULL,NULL,NULL,0,'pump-hot: already generated by Ada Lovelace (pump=north). Recover it first, or generate it again to change its details',NULL,1,1,'[{"text": "Main.lamp within 2 scans", "line": 6, "outcome": "not_checked", "recovery": false, "scan": null, "values": [], "reason": "not_raised", "note": "pump-hot: already generated by Ada Lovelace (pump=north). Recover it first, or generate it again to change its details"}]');
INSERT INTO "sweep_cell" VALUES(1,'pump-hot','Ready',445,NULL,NULL,NULL,0,'pump-hot: already generated by Ada Lovelace (pump=north). Recover it first, or generate it again to change its details',NULL,1,1,'[{"text": "Main.lamp within 2 scans", "line": 6, "outcome": "not_checked", "recovery": false, "scan": null, "values": [], "reason": "not_raised", "note": "pump-hot: already generated by Ada Lovelace (pump=north). Recover it first, or generate it again to change its details"}]');
CREATE TABLE test_record (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	title VARCHAR(255) NOT NULL, 
	text TEXT NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_test_record PRIMARY KEY (id), 
	CONSTRAINT fk_test_record_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "test_record" VALUES(1,1,'conveyor, line 1, version 1, 2026-11-24 14:27 UTC','<?xml version=''1.0'' encoding=''UTF-8''?>
<TestRecord Version="5" Project="conveyor" Model="CJ1M-CPU63" Instance="line 1" ProgramVersion="1" ProgramHash="b383da0df30a62264e4c303b72641f03611ec80f03565e4aac2fe306940e645c" ExportedAt="2026-11-24T14:27:01.610507+00:00" ExportedBy="Guest" Tool="Scanbench 0.1.0">
  <Error Id="memory-error" Name="Memory error" Group="CPU fatal errors / CPU fatal hardware errors" Code="80F1" Flag="A401.15" Severity="fatal" Status="never"/>
  <Error Id="io-bus-error:rack=0,slot=0" Name="I/O bus error" Group="CPU fatal errors / CPU fatal hardware errors" Code="80C0" Flag="A401.14" Severity="fatal" Status="never" Details="rack=0, slot=0" DetailsText="Rack number 0, Slot number 0"/>
  <Error Id="no-end-cover" Name="I/O bus error: no end cover" Group="CPU fatal errors / CPU fatal hardware errors" Code="80CE" Flag="A401.14" Severity="fatal" Status="never"/>
  <Error Id="io-bus-unknown-rack" Name="I/O bus error: unknown rack" Group="CPU fatal errors / CPU fatal hardware errors" Code="80CF" Flag="A401.14" Severity="fatal" Status="never"/>
  <Error Id="duplicated-unit-number" Name="Duplicated unit number" Group="CPU fatal errors / CPU fatal hardware errors" Code="80E9" Flag="A401.13" Severity="fatal" Status="never"/>
  <Error Id="duplicated-rack-number" Name="Duplicated rack number" Group="CPU fatal errors / CPU fatal hardware errors" Code="80EA" Flag="A401.13" Severity="fatal" Status="never"/>
  <Error Id="too-many-io" Name="Too many I/O points" Group="CPU fatal errors / CPU fatal hardware errors" Code="80E1" Flag="A401.11" Severity="fatal" Status="never"/>
  <Error Id="io-setting-error" Name="I/O setting error" Group="CPU fatal errors / CPU fatal hardware errors" Code="80E0" Flag="A401.10" Severity="fatal" Status="never"/>
  <Error Id="program-error" Name="Program error" Group="CPU fatal errors / CPU fatal program errors" Code="80F0" Flag="A401.09" Severity="fatal" Status="never"/>
  <Error Id="cycle-time-over" Name="Cycle time too long" Group="CPU fatal errors / CPU fatal program errors" Code="809F" Flag="A401.08" Severity="fatal" Status="never"/>
  <Error Id="fals" Name="FALS error" Group="CPU fatal errors / CPU fatal program errors" Code="C100" Flag="A401.06" Severity="fatal" Status="never"/>
  <Error Id="fal:number=1" Name="FAL error" Group="CPU nonfatal errors / CPU Unit" Code="4101" Flag="A402.15" Severity="nonfatal" Status="never" Details="number=1" DetailsText="FAL number 1">
    <Accepted State="Idle" Reason="no such instruction is used" By="Ada Lovelace" At="2026-11-24T14:27:01.374649+00:00"/>
  </Error>
  <Error Id="interrupt-task-error" Name="Interrupt task error" Group="CPU nonfatal errors / CPU Unit" Code="008B" Flag="A402.13" Severity="nonfatal" Status="never"/>
  <Error Id="plc-setup-error" Name="PLC Setup error" Group="CPU nonfatal errors / CPU Unit" Code="009B" Flag="A402.10" Severity="nonfatal" Status="never"/>
  <Error Id="io-verification-error" Name="I/O verification error" Group="CPU nonfatal errors / CPU Unit" Code="00E7" Flag="A402.09" Severity="nonfatal" Status="never"/>
  <Error Id="battery-error" Name="Battery error" Group="CPU nonfatal errors / CPU Unit" Code="00F7" Flag="A402.04" Severity="nonfatal" Status="never"/>
  <Error Id="basic-io-error:rack=0,slot=0" Name="Basic I/O Unit error" Group="CPU nonfatal errors / Units" Code="009A" Flag="A402.12" Severity="nonfatal" Status="cleared" Details="rack=0, slot=0" DetailsText="Rack number 0, Slot number 0" GeneratedAt="2026-11-24T14:27:00.593524+00:00" RecoveredAt="2026-11-24T14:27:00.794375+00:00" GeneratedScan="40" RecoveredScan="440" By="Ada Lovelace" Origin="simulator" Count="1">
    <Reaction Verdict="acted" Basis="exact" Window="200" FirstRead="1" FirstEffect="1" Differences="1">
      <Reader File="main.st" Line="12" Pou="Main" What="flag" Scan="1"/>
      <Output Path="Main.lamp" Without="FALSE" Value="TRUE" Scan="1"/>
      <Handler File="main.st" Line="12"/>
      <Required Text="Main.lamp within 2 scans" Line="4" Outcome="passed" Scan="1">
        <Value Path="Main.lamp" Value="TRUE"/>
      </Required>
      <Required Text="Main.lamp" Line="5" Outcome="not_checked" Reason="other_state" Note="a PLC that somebody works with is in none of the states of a sweep"/>
    </Reaction>
  </Error>
  <Error Id="inner-board-error" Name="Inner board error" Group="CPU nonfatal errors / Units" Code="02F0" Flag="A402.08" Severity="nonfatal" Status="never"/>
  <Error Id="cpu-bus-unit-error" Name="CPU Bus Unit error" Group="CPU nonfatal errors / Units" Code="0200" Flag="A402.07" Severity="nonfatal" Status="never"/>
  <Error Id="special-io-unit-error" Name="Special I/O Unit error" Group="CPU nonfatal errors / Units" Code="0300" Flag="A402.06" Severity="nonfatal" Status="never"/>
  <Error Id="special-io-unit-unknown" Name="Special I/O Unit error: unknown unit" Group="CPU nonfatal errors / Units" Code="03FF" Flag="A402.06" Severity="nonfatal" Status="never"/>
  <Error Id="cpu-bus-unit-setting-error" Name="CPU Bus Unit setting error" Group="CPU nonfatal errors / Units" Code="0400" Flag="A402.03" Severity="nonfatal" Status="never"/>
  <Error Id="special-io-unit-setting-error" Name="Special I/O Unit setting error" Group="CPU nonfatal errors / Units" Code="0500" Flag="A402.02" Severity="nonfatal" Status="never"/>
  <Error Id="pump-hot" Name="Pump hot" Group="User-defined / Pumps" Code="4101" Flag="W10.00" Severity="nonfatal" Status="generated" Details="pump=north" DetailsText="pump=north" GeneratedAt="2026-11-24T14:27:00.729655+00:00" GeneratedScan="240" By="Ada Lovelace" Origin="simulator" Count="1">
    <Reaction Verdict="no_effect" Basis="exact" Window="200" FirstRead="1" Differences="0" Note="basic-io-error:rack=0,slot=0 was present before: what follows from both is no difference">
      <Reader File="main.st" Line="12" Pou="Main" What="flag" Scan="1"/>
      <Required Text="Main.lamp within 2 scans" Line="6" Outcome="passed" Scan="1">
        <Value Path="Main.lamp" Value="TRUE"/>
      </Required>
    </Reaction>
  </Error>
  <Sweep At="2026-11-24T14:27:00.973218+00:00" By="Ada Lovelace" Instance="line 1" Status="done" Window="20">
    <State Name="Idle"/>
    <State Name="Ready"/>
    <Cell Error="io-bus-error:rack=0,slot=0" State="Idle" Verdict="stopped"/>
    <Cell Error="io-bus-error:rack=0,slot=0" State="Ready" Verdict="stopped"/>
    <Cell Error="fal:number=1" State="Idle" Verdict="never_read" Note="pump-hot:pump=north was present before: what follows from both is no difference" Accepted="true"/>
    <Cell Error="fal:number=1" State="Ready" Verdict="never_read" Note="pump-hot:pump=north was present before: what follows from both is no difference"/>
    <Cell Error="battery-error" State="Idle" Verdict="no_effect" Required="2" Unmet="1" Note="pump-hot:pump=north was present before: what follows from both is no difference"/>
    <Cell Error="battery-error" State="Ready" Verdict="no_effect" Required="2" Unmet="1" Note="pump-hot:pump=north was present before: what follows from both is no difference"/>
    <Cell Error="basic-io-error:rack=0,slot=0" State="Idle" Verdict="no_effect" Required="2" Unmet="1" Note="pump-hot:pump=north was present before: what follows from both is no difference"/>
    <Cell Error="basic-io-error:rack=0,slot=0" State="Ready" Verdict="no_effect" Required="1" Note="pump-hot:pump=north was present before: what follows from both is no difference"/>
    <Cell Error="pump-hot" State="Idle" Required="1" Unmet="1" Note="pump-hot: already generated by Ada Lovelace (pump=north). Recover it first, or generate it again to change its details">
      <Required Text="Main.lamp within 2 scans" Line="6" Outcome="not_checked" Reason="not_raised" Note="pump-hot: already generated by Ada Lovelace (pump=north). Recover it first, or generate it again to change its details"/>
    </Cell>
    <Cell Error="pump-hot" State="Ready" Required="1" Unmet="1" Note="pump-hot: already generated by Ada Lovelace (pump=north). Recover it first, or generate it again to change its details">
      <Required Text="Main.lamp within 2 scans" Line="6" Outcome="not_checked" Reason="not_raised" Note="pump-hot: already generated by Ada Lovelace (pump=north). Recover it first, or generate it again to change its details"/>
    </Cell>
    <Problem Line="7" Column="1" Message="CJ1M-CPU63 knows no error ''batery-error''. Did you mean `battery-error` or `memory-error` or `basic-io-error` or `io-bus-error`? Or write one of all, fatal, nonfatal. The requirement is not checked."/>
  </Sweep>
  <Line At="2026-11-24T14:27:00.593524+00:00" Scan="40" By="Ada Lovelace" Text="generated Basic I/O Unit error (Rack number 0, Slot number 0), code 009A"/>
  <Line At="2026-11-24T14:27:00.729655+00:00" Scan="240" By="Ada Lovelace" Text="generated Pump hot (pump=north), code 4101"/>
  <Line At="2026-11-24T14:27:00.794375+00:00" Scan="440" By="Ada Lovelace" Text="recovered Basic I/O Unit error"/>
</TestRecord>
','Bob Noyce','2026-11-24 14:27:01.622464');
CREATE TABLE trace (
	instance_id INTEGER NOT NULL, 
	number INTEGER NOT NULL, 
	content JSON NOT NULL, 
	CONSTRAINT pk_trace PRIMARY KEY (instance_id, number), 
	CONSTRAINT fk_trace_instance_id FOREIGN KEY(instance_id) REFERENCES instance (id) ON DELETE CASCADE
);
INSERT INTO "trace" VALUES(1,1,'{"definition": {"name": "All", "signals": ["Main.n", "Main.color", "Main.speed", "Main.fine", "Main.wait", "Main.ready", "Main.level + 1"], "every": 2, "scans": 30, "trigger": {"text": "Main.n", "when": "rises", "value": "20", "before": 70}, "repeat": true}, "by": "Ada Lovelace", "on": true}');
INSERT INTO "trace" VALUES(1,2,'{"definition": {"name": "Plain", "signals": ["Main.n"], "every": 1, "scans": 30000, "trigger": null, "repeat": false}, "by": "Bob Noyce", "on": true}');
CREATE TABLE trace_mapping (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	content JSON NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_trace_mapping PRIMARY KEY (id), 
	CONSTRAINT uq_trace_mapping_project_id_name UNIQUE (project_id, name), 
	CONSTRAINT fk_trace_mapping_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "trace_mapping" VALUES(1,1,'line 3','{"axis": "scan", "unit": "scan", "gaps": "refuse", "columns": [{"column": "Main.level", "path": "Main.level", "role": "input"}, {"column": "Main.doubled", "path": "Main.doubled", "role": "output"}, {"column": "remark", "path": "", "role": "ignore"}]}','Ada Lovelace','2026-11-24 14:27:01.646944');
CREATE TABLE trace_record (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	instance VARCHAR(100) NOT NULL, 
	content JSON NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_trace_record PRIMARY KEY (id), 
	CONSTRAINT fk_trace_record_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "trace_record" VALUES(1,1,'thirty scans','line 1','{"origin": "trace", "signals": [{"text": "Main.n", "type": "DINT", "kind": "int", "size": 4, "values": [], "message": ""}, {"text": "Main.color", "type": "Color", "kind": "int", "size": 2, "values": [["red", 0], ["green", 1], ["blue", 2]], "message": ""}, {"text": "Main.speed", "type": "REAL", "kind": "real", "size": 4, "values": [], "message": ""}, {"text": "Main.fine", "type": "LREAL", "kind": "real", "size": 8, "values": [], "message": ""}, {"text": "Main.wait", "type": "TIME", "kind": "time", "size": 8, "values": [], "message": ""}, {"text": "Main.ready", "type": "BOOL", "kind": "bool", "size": 1, "values": [], "message": ""}, {"text": "Main.level + 1", "type": "INT", "kind": "int", "size": 2, "values": [], "message": ""}], "every": 2, "triggered": 19, "first": 0, "end": 27, "rows": 14, "interval_ns": 10000000, "version": 1}','Ada Lovelace','2026-11-24 14:27:01.382598');
INSERT INTO "trace_record" VALUES(2,1,'Scans 435 to 444','line 1','{"origin": "retrospective", "signals": [{"text": "Main.n", "type": "DINT", "kind": "int", "size": 4, "values": [], "message": ""}, {"text": "Main.color", "type": "Color", "kind": "int", "size": 2, "values": [["red", 0], ["green", 1], ["blue", 2]], "message": ""}], "every": 1, "triggered": null, "first": 435, "end": 445, "rows": 10, "interval_ns": 10000000, "version": 1}','Ada Lovelace','2026-11-24 14:27:01.591015');
CREATE TABLE verification_record (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	instance VARCHAR(100) NOT NULL, 
	content JSON NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_verification_record PRIMARY KEY (id), 
	CONSTRAINT fk_verification_record_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "verification_record" VALUES(1,1,'five scans','line 1','{"status": "c8015901dc001eb2566572696669636174696f6e5374617475730101ac416461204c6f76656c616365c7300196aa56657269667957697368c7130196a552616e6765a0a76d61696e2e7374080aa0a466726565cd01b8cd01bccd1000a470617374a466726565c2a87265636f72646564a4646f6e65a0b34d61696e2c206c696e6573203820746f203130a091a44d61696e01ce00989680cd01b8cd01bccd01bc05009001c7ae019aa84d69736d61746368a56c6f676963ac4d61696e2e646f75626c6564c402c000c402c800c7350197a5506c616365a44d61696ea44d61696ea44d61696ea76d61696e2e737409b5646f75626c6564203a3d206c6576656c202a20323bd9464d61696e2e646f75626c6564206973203139322c20746865207265666572656e6365206769766573203230302c206174206d61696e2e73743a3920696e207363616e20343432a3494e54a3696e7402cd01ba05000600a0", "model": "CJ1M-CPU63"}','Ada Lovelace','2026-11-24 14:27:00.938896');
CREATE TABLE watch_list (
	id INTEGER NOT NULL, 
	project_id INTEGER NOT NULL, 
	owner VARCHAR(100) NOT NULL, 
	name VARCHAR(100) NOT NULL, 
	content JSON NOT NULL, 
	version INTEGER NOT NULL, 
	"by" VARCHAR(100) NOT NULL, 
	at DATETIME NOT NULL, 
	CONSTRAINT pk_watch_list PRIMARY KEY (id), 
	CONSTRAINT uq_watch_list_project_id_owner_name UNIQUE (project_id, owner, name), 
	CONSTRAINT fk_watch_list_project_id FOREIGN KEY(project_id) REFERENCES project (id) ON DELETE CASCADE
);
INSERT INTO "watch_list" VALUES(1,1,'','Belt 3','{"groups": ["belt", "none"], "entries": [["Main.n", "belt", "hex"], ["W10:8", "", "default"]]}',2,'Bob Noyce','2026-11-24 14:27:00.537071');
INSERT INTO "watch_list" VALUES(2,1,'Bob Noyce','Mine','{"groups": [], "entries": [["Main.level", "", "default"]]}',1,'Bob Noyce','2026-11-24 14:27:00.532632');
CREATE INDEX ix_instance_project_id ON instance (project_id);
CREATE INDEX ix_log_instance_id_id ON log (instance_id, id);
CREATE INDEX ix_sweep_project_id ON sweep (project_id);
CREATE INDEX ix_test_record_project_id ON test_record (project_id);
CREATE INDEX ix_trace_record_project_id ON trace_record (project_id);
CREATE INDEX ix_verification_record_project_id ON verification_record (project_id);
CREATE INDEX ix_draft_part_project_id_path ON draft_part (project_id, path);
COMMIT;
